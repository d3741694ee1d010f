"""The picture of verify: the data that it shows, labels with units."""

import dataclasses
import itertools

import numpy as np
import pytest
from matplotlib.figure import Figure

from figure_checks import UNIT, check_lines, legend, unique, unmarked
from microslip.figures.abscissa import abscissa
from microslip.figures.agreement import agreement_figure
from microslip.figures.track import track_figure
from microslip_mechanics.results.response_curve import ResponseCurve


def test_agreement_figure_shows_curve_orbits_envelopes_and_energies(
    small_curve: ResponseCurve,
) -> None:
    frequency = np.array([133.0, 130.0])
    difference, admitted = np.array([2e-3, 1e-4]), np.array([1e-3, 5e-4])
    marched = np.arange(8.0).reshape(2, 4) * 1e-4
    swept = np.linspace(130.0, 134.0, 9)
    slower, error = np.array([1.0, 4.0, 10.0]), np.array([0.4, -0.1, 0.05])

    figure = agreement_figure(
        unmarked(small_curve),
        (frequency, marched, difference, admitted),
        [
            ("1 x as long", swept, 1e-4 * swept[:, None]),
            ("4 x as long", swept, 2e-4 * swept[:, None]),
        ],
        (slower, error),
        "two-blades",
    )

    check_labels_of_agreement(figure)
    response, deviations, envelopes, energies = figure.axes
    check_lines(response.lines[3:], frequency, [*1e3 * marched.T[:3]])
    limits, *dots = deviations.lines
    check_lines([limits], [130.0, 133.0], [[0.05, 0.1]])
    check_lines(dots[:1], [130.0], [[0.01]])
    check_lines(dots[1:], [133.0], [[0.2]])
    assert legend(deviations) == ["admitted", "difference", "too much"]
    check_lines(envelopes.lines[:2], swept, [0.1 * swept, 0.2 * swept])
    hertz = abscissa(small_curve)
    check_lines(envelopes.lines[2:], hertz, [1e3 * small_curve.peak[:, 0]])
    assert legend(envelopes) == ["1 x as long", "4 x as long", "curve"]
    check_lines(energies.lines, slower, [[40.0, 10.0, 5.0]])
    assert energies.lines[0].get_linestyle() == "None"


def test_envelopes_are_those_of_a_probe_that_moves(small_curve: ResponseCurve) -> None:
    peak = small_curve.peak * 1e-14
    peak[:, 1] *= 1e14
    still = dataclasses.replace(small_curve, peak=peak)
    nothing, swept = np.zeros(0), np.linspace(130.0, 134.0, 9)
    envelope = np.stack([0.0 * swept, 1e-4 * swept], axis=1)

    figure = agreement_figure(
        unmarked(still),
        (nothing, np.empty((0, 4)), nothing, nothing),
        [("1 x as long", swept, envelope)],
        (nothing, nothing),
        "",
    )

    (envelopes,) = (
        axes for axes in figure.axes if "Envelope" in axes.get_title("left")
    )
    assert envelopes.get_title("left").endswith(small_curve.probes[1].replace("-", " "))
    check_lines(envelopes.lines[:1], swept, [0.1 * swept])
    check_lines(envelopes.lines[1:], abscissa(still), [1e3 * peak[:, 1]])


def test_envelopes_are_shown_where_the_sweeps_are(small_curve: ResponseCurve) -> None:
    """The first probe, whose peak the sweeps do not reach, hardly moves in them."""
    peak = np.array([[1e-6, 1e-4], [1e-6, 2e-4], [1e-6, 3e-4], [5e-3, 1e-4]])
    beyond = dataclasses.replace(
        small_curve, peak=np.hstack([peak, 1e-9 * small_curve.peak[:, 2:]])
    )
    nothing, swept = np.zeros(0), np.linspace(130.0, 133.0, 9)
    envelope = np.tile([1e-6, 3e-4, 0.0, 0.0], (9, 1))

    figure = agreement_figure(
        unmarked(beyond),
        (nothing, np.empty((0, 4)), nothing, nothing),
        [("1 x as long", swept, envelope), ("4 x as long", swept, envelope)],
        (nothing, nothing),
        "",
    )

    (envelopes,) = (
        axes for axes in figure.axes if "Envelope" in axes.get_title("left")
    )
    check_lines(envelopes.lines[:2], swept, [np.full(9, 0.3)] * 2)
    assert envelopes.get_xlim() == (130.0, 133.0)
    assert envelopes.get_ylim()[0] == 0.0
    assert 0.3 < envelopes.get_ylim()[1] < 0.9  # a legend takes room above lines


def test_dots_have_the_colours_of_their_lines(small_curve: ResponseCurve) -> None:
    size = np.array([1e-5, 3e-4, 1e-4, 2e-4, 5e-4])
    amplitude = np.ones((4, 1)) * size
    many = dataclasses.replace(
        unmarked(small_curve),
        probes=("a", "b", "c", "d", "e"),
        amplitude=amplitude,
        peak=amplitude,
        velocity_peak=amplitude,
    )
    one = np.array([1e-5])

    figure = agreement_figure(
        unique(many), (np.array([132.0]), size[None], one, one), [], (one, one), ""
    )

    *lines, largest = figure.axes[0].lines[:5]
    dots = figure.axes[0].lines[5:]
    assert largest.get_label() == "largest"
    assert len(dots) == 4
    for line, dot in zip(lines, dots, strict=True):
        assert dot.get_color() == line.get_color()
        assert np.asarray(dot.get_ydata())[0] == np.asarray(line.get_ydata())[0]


def test_without_any_orbit_there_is_no_panel_of_differences(
    small_curve: ResponseCurve,
) -> None:
    none = np.zeros(0)

    figure = agreement_figure(
        small_curve, (none, np.zeros((0, 5)), none, none), [], (none, none), ""
    )

    figure.draw_without_rendering()  # would warn of axes that collapse
    (curve,) = figure.axes
    assert curve.get_position().width > 0.3


def check_labels_of_agreement(figure: Figure) -> None:
    """Check the labels where each panel has a frequency or a factor of its own."""
    figure.draw_without_rendering()
    *others, energies = figure.axes
    for axes in others:
        assert UNIT.search(axes.get_xlabel())
    for axes in figure.axes:
        assert UNIT.search(axes.get_ylabel())
    assert energies.get_xlabel() == "sweep slower by"


def test_agreement_without_sweeps_is_drawn_too(small_curve: ResponseCurve) -> None:
    nothing = np.zeros(0)
    one = np.array([1e-3])
    found = (np.array([130.0]), np.full((1, 4), 1e-4), one, 2.0 * one)

    figure = agreement_figure(small_curve, found, [], (nothing, nothing), "title")

    figure.draw_without_rendering()
    assert len(figure.axes) == 2
    for axes in figure.axes:
        assert UNIT.search(axes.get_xlabel())
        assert UNIT.search(axes.get_ylabel())


@pytest.mark.parametrize(
    "values", [[0.4, 0.6, 0.8, 20.0], [1e-3, 2e-3, 1.0], [0.125, 0.25, 0.375, 3.0]]
)
def test_labels_of_near_values_do_not_touch(values: list[float]) -> None:
    peaks = [(value, 130.0, 1e-3) for value in values]

    figure = track_figure(peaks, [], "excitation.force", "title")

    figure.draw_without_rendering()
    for axes in figure.axes:
        boxes = [
            label.get_window_extent()
            for label in axes.get_xticklabels()
            if label.get_text()
        ]
        assert len(boxes) >= 2
        for left, right in itertools.pairwise(boxes):
            assert left.x1 < right.x0


def test_values_that_are_no_numbers_have_their_names_and_no_line() -> None:
    peaks = [(0.0, 130.0, 1e-3), (1.0, 131.0, 2e-3)]

    figure = track_figure(peaks, [], "friction.law", "title", ["coulomb", "gkf"])

    for axes in figure.axes:
        ticks = [label.get_text() for label in axes.get_xticklabels()]
        assert ticks == ["coulomb", "gkf"]
        assert axes.lines[0].get_linewidth() == 0.0


@pytest.mark.parametrize(
    "values",
    [[0.4, 0.6, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0], [0.1, 0.11, 0.12, 0.2, 1.0, 5.0]],
)
def test_no_tick_of_a_parameter_is_without_its_label(values: list[float]) -> None:
    peaks = [(value, 130.0, 1e-3) for value in values]

    figure = track_figure(peaks, [], "preload.force", "title")

    figure.draw_without_rendering()
    for axes in figure.axes:
        labels = [label.get_text() for label in axes.get_xticklabels()]
        assert len(labels) >= 2
        assert all(labels)
        assert not axes.get_xticks(minor=True).size
