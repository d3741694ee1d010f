"""Amplitudes of curves: stable and unstable stretches, events, and their close-up."""

import dataclasses

import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from figure_checks import check_lines, legend, unique, unmarked
from microslip.figures.abscissa import abscissa
from microslip.figures.amplitude import frequency_response, stretches
from microslip.figures.close_up import close_up, crowd, worth
from microslip_mechanics.results.response_curve import ResponseCurve


def test_unstable_stretches_and_events_are_marked_on_the_largest_amplitude(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    frequency_response(axes, small_curve)

    largest = 1e3 * small_curve.amplitude[:, :3].max(axis=1)
    unstable, *marks = axes.lines[3:]
    drawn = np.asarray(unstable.get_ydata(), dtype=float)
    np.testing.assert_allclose(drawn[2:], largest[2:])
    assert np.isnan(drawn[:2]).all()
    seen = {
        str(mark.get_label()): (mark.get_xdata()[0], mark.get_ydata()[0])  # type: ignore[index]
        for mark in marks
    }
    hertz = abscissa(small_curve)
    assert seen == {
        "peak": (hertz[1], largest[1]),
        "fold": (hertz[2], largest[2]),
    }


def test_frequency_response_shows_absolute_motions_in_millimetres(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve = unmarked(small_curve)

    frequency_response(axes, small_curve)

    hertz = [130.0, 131.0, 133.0, 134.0]
    check_lines(axes.lines, hertz, [*1e3 * small_curve.amplitude.T[:3]])
    assert legend(axes) == ["excited blade", "follower blade", "element"]
    assert axes.get_xlabel() == "excitation frequency [Hz]"
    assert axes.get_ylabel() == "amplitude [mm]"
    assert axes.get_ylim()[0] == 0.0


def test_a_curve_that_nothing_bounds_is_drawn_by_decades(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve = unmarked(small_curve)
    small_curve.amplitude[2] *= 1e8

    frequency_response(axes, small_curve)

    assert axes.get_yscale() == "log"


def test_curve_that_folds_back_is_drawn_as_it_was_traced(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    small_curve.frequency[:] = 2.0 * np.pi * np.array([130.0, 132.0, 131.0, 133.0])

    frequency_response(axes, small_curve)

    shown = np.asarray(axes.lines[0].get_xdata())
    np.testing.assert_allclose(shown, [130.0, 132.0, 131.0, 133.0])


def test_of_many_motions_the_greatest_are_drawn(small_curve: ResponseCurve) -> None:
    sizes = np.array([3.0, 1.0, 9.0, 2.0, 8.0, 7.0])
    curve = dataclasses.replace(
        small_curve,
        probes=tuple(f"tip-{place}" for place in range(6)),
        amplitude=np.tile(sizes, (4, 1)),
    )
    axes = Figure().subplots()

    frequency_response(axes, unique(curve))

    labels = [line.get_label() for line in axes.lines]
    assert labels[:5] == ["tip 0", "tip 2", "tip 4", "tip 5", "largest"]
    assert axes.get_title(loc="left") == "First harmonic: the greatest 4 of 6"
    assert axes.get_ylim()[1] > 9e3


def _located(
    curve: ResponseCurve, hertz: list[float], events: tuple[str, ...]
) -> ResponseCurve:
    """Return a curve of other points, at which all motions are of one size."""
    count = len(hertz)
    made = dataclasses.replace(
        curve,
        frequency=2.0 * np.pi * np.array(hertz),
        amplitude=np.full((count, len(curve.probes)), 1e-3),
        unstable=np.zeros(count),
        event=events,
    )
    return unique(made)


def test_a_change_of_stability_ends_both_lines(small_curve: ResponseCurve) -> None:
    hertz = [130.0, 131.0, 132.0, 133.0, 134.0, 135.0, 136.0]
    events = ("", "fold", "", "peak", "fold", "", "")
    curve = _located(small_curve, hertz, events)
    # a fold may count as either: its multiplier is one but for rounding
    curve = dataclasses.replace(curve, unstable=np.array([0, 1, 1, 1, 0, 0, 0]))

    stable, unstable = stretches(curve)

    assert stable.tolist() == [True, True, False, False, True, True, True]
    assert unstable.tolist() == [False, True, True, True, True, False, False]


def test_events_are_a_crowd_where_their_markers_would_cover_each_other(
    small_curve: ResponseCurve,
) -> None:
    hertz = [125.0, 130.0, 134.9, 135.0, 135.2, 140.0, 145.0]
    events = ("", "fold", "", "peak", "Neimark-Sacker", "fold", "")
    curve = _located(small_curve, hertz, events)
    above = dataclasses.replace(curve, amplitude=curve.amplitude.copy())
    above.amplitude[4] *= 0.8

    assert crowd(curve) == [3, 4]
    assert crowd(above) == []


def test_a_close_up_shows_what_is_around_a_crowd(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    hertz = [125.0, 130.0, 134.9, 135.0, 135.2, 140.0, 135.1, 125.0]
    events = ("", "fold", "", "peak", "Neimark-Sacker", "fold", "", "")
    curve = _located(small_curve, hertz, events)
    sizes = [0.1e-3, 0.2e-3, 1.5e-3, 1.6e-3, 1.55e-3, 0.2e-3, 9e-3, 10e-3]
    curve.amplitude[:, 0] = sizes  # comes back far above the crowd

    close_up(axes, curve)

    # not where the amplitude is largest of all: that is elsewhere
    title = "Close-up of the first harmonic, largest of probes"
    assert axes.get_title(loc="left") == title
    np.testing.assert_allclose(axes.get_xlim(), (134.9, 135.3))
    low, high = axes.get_ylim()
    assert 1.4 < low < 1.5
    assert 1.6 < high < 1.7
    assert legend(axes) == ["stable", "point", "peak", "fold", "Neimark-Sacker"]
    axes.clear()
    close_up(axes, dataclasses.replace(curve, unstable=curve.unstable - 1.0))
    assert legend(axes)[0] == "curve"  # nobody knows whether it is stable


def test_a_close_up_of_nearly_everything_is_none(small_curve: ResponseCurve) -> None:
    hertz = [float(each) for each in np.linspace(2.0, 12.0, 41)]
    beside = ("",) * 19 + ("fold", "peak") + ("",) * 20

    assert worth(_located(small_curve, hertz, beside))
    assert not worth(_located(small_curve, hertz, ("fold",) * 41))
    assert not worth(_located(small_curve, hertz, ("",) * 41))


def test_a_branch_and_its_point_at_one_place_have_no_close_up(
    small_curve: ResponseCurve,
) -> None:
    hertz = [125.0, 130.0, 135.0, 145.0, 135.0, 140.0]
    events = ("", "", "branch point", "", "branch", "")

    assert not worth(_located(small_curve, hertz, events))


def test_a_curve_without_points_has_no_crowd(small_curve: ResponseCurve) -> None:
    assert crowd(_located(small_curve, [], ())) == []


def test_an_amplitude_that_hardly_changes_does_not_lie_on_the_frame(
    axes: Axes, small_curve: ResponseCurve
) -> None:
    size = np.linspace(1.0, 1.001, 4)[:, None] * np.ones(len(small_curve.probes))
    curve = unique(dataclasses.replace(small_curve, amplitude=1e-3 * size))

    frequency_response(axes, curve)

    assert axes.get_ylim() == pytest.approx((0.0, 1.04 * 1.001))
