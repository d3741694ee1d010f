"""Figures: the data that they show, labels with units, no screen."""

import dataclasses
import itertools
import re
from collections.abc import Iterable, Sequence

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from microslip.figures import curve as curves
from microslip.figures import sweep as sweeps
from microslip.figures.agreement import agreement_figure
from microslip.figures.envelope import envelope_figure
from microslip.figures.passes import passes
from microslip.figures.result import result_figure
from microslip.figures.track import track_figure
from microslip_mechanics.envelope import Envelope
from microslip_mechanics.response import ResponseCurve
from microslip_mechanics.time_history import TimeHistory

UNIT = re.compile(r" \[.+\]$")


@pytest.fixture
def axes() -> Axes:
    """Return axes without a screen."""
    return Figure().subplots()


def check_lines(lines: Iterable[Line2D], x: ArrayLike, ys: Sequence[ArrayLike]) -> None:
    """Check that each line shows ``x`` and its own ``y``, in order."""
    for line, y in zip(lines, ys, strict=True):
        shown = np.asarray(line.get_xydata())
        np.testing.assert_allclose(shown[:, 0], np.asarray(x), rtol=1e-12)
        np.testing.assert_allclose(shown[:, 1], np.asarray(y), rtol=1e-12)


def legend(axes: Axes) -> list[str]:
    """Return the texts of the legend."""
    drawn = axes.get_legend()
    assert drawn is not None
    return [text.get_text() for text in drawn.get_texts()]


def check_labels(figure: Figure) -> None:
    """Check that every panel says what it shows, and in which unit."""
    figure.draw_without_rendering()
    bottom: dict[int, Axes] = {}
    for axes in figure.axes:
        title = axes.get_title(loc="left")
        assert title
        assert UNIT.search(axes.get_ylabel()), title
        assert axes.yaxis.get_tick_params()["labelleft"], title
        place = axes.get_subplotspec()
        assert place is not None
        bottom[place.colspan.start] = axes
    for axes in bottom.values():
        title = axes.get_title(loc="left")
        assert UNIT.search(axes.get_xlabel()), title
        assert axes.xaxis.get_tick_params()["labelbottom"], title


def unmarked(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve of whose stability and events nothing is known."""
    points = len(curve.event)
    return dataclasses.replace(
        curve, unstable=np.full(points, -1.0), event=("",) * points
    )


def test_unstable_stretches_and_events_are_marked_on_the_largest_amplitude(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.frequency_response(axes, small_curve)

    largest = 1e3 * small_curve.amplitude[:, :3].max(axis=1)
    unstable, *marks = axes.lines[3:]
    drawn = np.asarray(unstable.get_ydata(), dtype=float)
    np.testing.assert_allclose(drawn[2:], largest[2:])
    assert np.isnan(drawn[:2]).all()
    seen = {
        str(mark.get_label()): (mark.get_xdata()[0], mark.get_ydata()[0])  # type: ignore[index]
        for mark in marks
    }
    hertz = curves.abscissa(small_curve)
    assert seen == {
        "peak": (hertz[1], largest[1]),
        "fold": (hertz[2], largest[2]),
    }


def test_frequency_response_shows_absolute_motions_in_millimetres(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve = unmarked(small_curve)

    curves.frequency_response(axes, small_curve)

    hertz = [130.0, 131.0, 133.0, 134.0]
    check_lines(axes.lines, hertz, [*1e3 * small_curve.amplitude.T[:3]])
    assert legend(axes) == ["excited blade", "follower blade", "element"]
    assert axes.get_xlabel() == "excitation frequency [Hz]"
    assert axes.get_ylabel() == "amplitude [mm]"
    assert axes.get_ylim()[0] == 0.0


def test_sliding_velocity_shows_relative_motions(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.sliding_velocity(axes, small_curve)

    hertz = curves.abscissa(small_curve)
    check_lines(axes.lines, hertz, [small_curve.velocity_peak[:, 3]])
    assert legend(axes) == ["element to excited"]
    assert axes.get_ylabel() == "velocity [m/s]"
    assert axes.get_yscale() == "log"


def test_dissipated_energy_shows_friction_and_contact_damping_in_millijoules(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.dissipated_energy(axes, small_curve)

    energies = [1e3 * small_curve.friction_energy, 1e3 * small_curve.damping_energy]
    check_lines(axes.lines, curves.abscissa(small_curve), energies)
    assert legend(axes) == ["friction", "normal contact damping"]
    assert axes.get_ylabel() == "energy [mJ]"


def test_normal_forces_show_the_range_of_every_point(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    curves.normal_forces(axes, small_curve)

    hertz = curves.abscissa(small_curve)
    check_lines(axes.lines, hertz, [*small_curve.normal_largest.T])
    assert legend(axes) == ["B1", "B2", "A1"]
    assert axes.get_ylabel() == "force [N]"
    low = small_curve.normal_smallest
    for place, band in enumerate(axes.collections):
        (path,) = band.get_paths()
        shown = np.asarray(path.vertices)
        assert shown[:, 1].min() == pytest.approx(low[:, place].min())
        assert shown[:, 1].max() == pytest.approx(
            small_curve.normal_largest[:, place].max()
        )


def test_curve_figure_has_four_labelled_panels(small_curve: ResponseCurve) -> None:
    figure = curves.curve_figure(small_curve, "two-blades, model=A")

    check_labels(figure)
    assert len(figure.axes) == 4
    assert figure.get_suptitle() == "two-blades, model=A"


def test_curve_that_folds_back_is_drawn_as_it_was_traced(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve.frequency[:] = 2.0 * np.pi * np.array([130.0, 132.0, 131.0, 133.0])

    curves.frequency_response(axes, small_curve)

    shown = np.asarray(axes.lines[0].get_xdata())
    np.testing.assert_allclose(shown, [130.0, 132.0, 131.0, 133.0])


def test_displacement_shows_one_probe_in_millimetres(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.displacement(axes, small_history, 1, "C0")

    moved = 1e3 * small_history.displacement[:, 1]
    check_lines(axes.lines, small_history.time, [moved])
    assert "follower blade" in axes.get_title(loc="left")
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("time [s]", "displacement [mm]")


def test_relative_velocity_shows_one_probe(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.relative_velocity(axes, small_history, 3)

    check_lines(axes.lines, small_history.time, [small_history.velocity[:, 3]])
    assert "element to excited" in axes.get_title(loc="left")
    assert axes.get_ylabel() == "velocity [m/s]"


def test_normal_force_shows_the_points_of_one_face(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.normal_force(axes, small_history, "B", [0, 1])

    check_lines(axes.lines, small_history.time, [*small_history.normal_force.T[:2]])
    assert legend(axes) == ["B1", "B2"]
    assert axes.get_ylabel() == "force [N]"


def test_friction_power_is_shown_negative_as_in_the_paper(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.friction_power(axes, small_history)

    power = -small_history.friction_power
    check_lines(axes.lines, small_history.time, [power])
    assert axes.get_ylabel() == "power [W]"


def test_energies_show_all_flows_with_their_totals(
    axes: Axes, small_history: TimeHistory
) -> None:
    sweeps.energies(axes, small_history)

    check_lines(axes.lines, small_history.time, [*small_history.energy.T[:4]])
    names = ("input", "friction", "normal damping", "structural damping")
    totals = small_history.energy[-1, :4]
    assert legend(axes) == [
        f"{name}: {total:.4g} J" for name, total in zip(names, totals, strict=True)
    ]
    assert axes.get_ylabel() == "energy [J]"
    closing = np.abs(small_history.closing_error).max()
    assert f"{closing:.1e} J" in axes.get_title(loc="left")


def test_sweep_figure_has_a_labelled_panel_for_each_thing_to_see(
    small_history: TimeHistory,
) -> None:
    figure = sweeps.sweep_figure(small_history, "two-blades")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    # two blades, one slip, two faces, power, energies
    assert len(titles) == len(set(titles)) == 7
    assert figure.get_suptitle() == "two-blades"


def test_sweep_figure_shows_both_blades_on_one_scale(
    small_history: TimeHistory,
) -> None:
    figure = sweeps.sweep_figure(small_history, "two-blades")

    limits = [axes.get_ylim() for axes in figure.axes[:2]]
    largest = 1e3 * np.abs(small_history.displacement[:, :2]).max()
    assert limits[0] == limits[1]
    assert limits[0] == pytest.approx((-1.05 * largest, 1.05 * largest))


def test_agreement_figure_shows_curve_orbits_envelopes_and_energies(
    small_curve: ResponseCurve,
) -> None:
    frequency, deviation = np.array([130.0, 133.0]), np.array([1e-4, 2e-3])
    marched = np.arange(8.0).reshape(2, 4) * 1e-4
    swept = np.linspace(130.0, 134.0, 9)
    slower, error = np.array([1.0, 4.0, 10.0]), np.array([0.4, -0.1, 0.05])

    figure = agreement_figure(
        unmarked(small_curve),
        (frequency, marched, deviation),
        [("1 x as long", swept, 1e-4 * swept), ("4 x as long", swept, 2e-4 * swept)],
        (slower, error),
        "two-blades",
    )

    check_labels_of_agreement(figure)
    response, deviations, envelopes, energies = figure.axes
    check_lines(response.lines[3:], frequency, [*1e3 * marched.T[:3]])
    check_lines(deviations.lines, frequency, [100.0 * deviation])
    check_lines(envelopes.lines[:2], swept, [0.1 * swept, 0.2 * swept])
    hertz = curves.abscissa(small_curve)
    check_lines(envelopes.lines[2:], hertz, [1e3 * small_curve.peak[:, 0]])
    assert legend(envelopes) == ["1 x as long", "4 x as long", "curve"]
    check_lines(energies.lines, slower, [[40.0, 10.0, 5.0]])


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
    marched = (np.array([130.0]), np.full((1, 4), 1e-4), np.array([1e-3]))

    figure = agreement_figure(small_curve, marched, [], (nothing, nothing), "title")

    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert [title.split(",")[0] for title in titles] == [
        "Curve",
        "Amplitude after the march",
    ]


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


@pytest.mark.parametrize("panel", ["sweep", "curve"])
def test_legend_of_energies_lies_above_their_lines(
    axes: Axes, panel: str, small_history: TimeHistory, small_curve: ResponseCurve
) -> None:
    if panel == "sweep":
        sweeps.energies(axes, small_history)
    else:
        curves.dissipated_energy(axes, small_curve)

    axes.figure.draw_without_rendering()  # type: ignore[union-attr]
    shown = axes.get_legend()
    assert shown is not None
    below = axes.transData.inverted().transform(shown.get_window_extent())[0, 1]
    assert below > max(np.max(line.get_ydata()) for line in axes.lines)


def swept(hertz: np.ndarray, level: np.ndarray, small: Envelope) -> Envelope:
    """Return an envelope whose first probe swings by the frequency in micrometres."""
    cycles = len(hertz)
    made = {
        field.name: np.resize(getattr(small, field.name), (cycles, *shape[1:]))
        for field in dataclasses.fields(small)
        if len(shape := np.shape(getattr(small, field.name))) > 0
        and field.name not in ("probes", "contacts", "energies")
    }
    high = np.tile(1e-6 * hertz[:, None], (1, len(small.probes)))
    changed = {
        "time": np.cumsum(1.0 / hertz),
        "frequency": 2.0 * np.pi * hertz,
        "level": level,
        "highest": high,
        "lowest": -high,
    }
    return dataclasses.replace(small, **(made | changed))


def test_each_way_of_a_sweep_is_a_pass(small_envelope: Envelope) -> None:
    up = np.linspace(125.0, 145.0, 50)
    rest = np.full(20, 125.0)
    hertz = np.concatenate([rest, up, up[::-1], rest, up, up[::-1], rest])
    level = np.repeat([0.0, 0.5, 0.0, 2.0, 0.0], [20, 100, 20, 100, 20])

    ways = passes(swept(hertz, level, small_envelope))

    assert [(way.level, way.rises) for way in ways] == [
        (0.5, True),
        (0.5, False),
        (2.0, True),
        (2.0, False),
    ]
    for way in ways:
        assert 49 <= len(way.hertz) <= 51
        np.testing.assert_allclose(way.swing[:, 0], 1e-6 * way.hertz)


def test_steps_are_one_pass(small_envelope: Envelope) -> None:
    hertz = np.repeat(np.linspace(125.0, 145.0, 11), 20)

    (way,) = passes(swept(hertz, np.ones(220), small_envelope))

    assert way.rises
    assert len(way.hertz) == 220


def test_a_dwell_has_no_pass(small_envelope: Envelope) -> None:
    assert passes(swept(np.full(100, 130.0), np.ones(100), small_envelope)) == []


def test_passes_of_rows_are_those_of_the_drive(small_history: TimeHistory) -> None:
    time = np.arange(1, 20_001) * 1e-4
    hertz = np.linspace(50.0, 80.0, 20_000)
    phase = 2.0 * np.pi * np.cumsum(hertz) * 1e-4
    rows = np.ones((20_000, 4)) * np.sin(phase)[:, None]
    history = dataclasses.replace(
        small_history,
        time=time,
        displacement=rows,
        frequency=2.0 * np.pi * hertz,
        level=np.ones(20_000),
    )

    (way,) = passes(history)

    assert len(way.hertz) == pytest.approx(130, abs=1)
    # 125 rows a cycle at most: the highest lies within half of one of them
    np.testing.assert_allclose(way.swing[:-1], 1.0, atol=4e-3)


def test_envelope_figure_has_a_labelled_panel_for_each_thing_to_see(
    small_envelope: Envelope,
) -> None:
    up = np.linspace(125.0, 145.0, 50)
    hertz, level = np.concatenate([up, up[::-1]]), np.ones(100)

    figure = envelope_figure(swept(hertz, level, small_envelope), "two-blades")

    check_labels(figure)
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    # as those of a sweep, and the amplitude of both blades against frequency
    assert len(titles) == len(set(titles)) == 9
    assert legend(figure.axes[-1]) == ["up", "down"]


def test_march_without_rows_is_not_drawn(small_envelope: Envelope) -> None:
    none = swept(np.zeros(0), np.zeros(0), small_envelope)

    with pytest.raises(ValueError, match="no cycle is complete"):
        result_figure(none, "title")
