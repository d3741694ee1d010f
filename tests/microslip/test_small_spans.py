"""Pictures of few values: names on the axis, limits that are seen, no rounding."""

import math

import numpy as np
import pytest
from matplotlib.axes import Axes

from microslip.figures.decay import decay_figure
from microslip.figures.modes import ModeLine, modes_figure
from microslip.figures.poles import poles_figure
from microslip.figures.style import widened
from microslip.figures.track import track_figure
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.results.ring_down import RingDown
from microslip_mechanics.results.time_history import TimeHistory

SPAN = (1.0, 1e3)


def poles(*values: complex) -> ComplexArray:
    return np.array(values, dtype=complex)[:, None]


@pytest.mark.parametrize(
    ("values", "error", "span"),
    [
        ([135.0, 135.0 + 1e-12], 0.0, 1.1 * 1e-6 * 135.0),
        ([135.0, 135.0 + 1e-12], 1e-2, 1.1 * 2e-2),
    ],
)
def test_an_axis_does_not_show_rounding(
    axes: Axes, values: list[float], error: float, span: float
) -> None:
    axes.plot(values)

    widened(axes, error)

    assert np.ptp(axes.get_ylim()) == pytest.approx(span, rel=1e-3)


def test_an_axis_that_shows_more_stays(axes: Axes) -> None:
    axes.plot([1.0, 2.0])
    before = axes.get_ylim()

    widened(axes, 1e-3)

    assert axes.get_ylim() == before


def test_poles_of_named_values_stand_at_their_names() -> None:
    pole, stuck = poles(-1 + 100j, -1 + 100j), poles(-1 + 110j, -2 + 120j)
    limits = {"free": pole, "stuck": stuck}

    figure = poles_figure([0.0, 1.0], pole, limits, SPAN, "model", "", ["A", "B"])

    frequency, damping, path = figure.axes
    for axes in (frequency, damping):
        assert [label.get_text() for label in axes.get_xticklabels()] == ["A", "B"]
    assert [line.get_linestyle() for line in path.lines] == ["None"]
    drawn = [line for line in frequency.lines if line.get_color() == "0.35"]
    for line, ends in zip(drawn, [(-0.3, 0.3), (0.7, 1.3)] * 2, strict=True):
        assert np.asarray(line.get_xdata()).tolist() == pytest.approx(list(ends))


def test_limits_of_one_value_are_drawn_across() -> None:
    limits = {"free": poles(-1 + 90j), "stuck": poles(complex(np.nan, np.nan))}

    figure = poles_figure([0.3], poles(-1 + 100j), limits, SPAN, "friction", "")

    frequency = figure.axes[0]
    (line,) = (line for line in frequency.lines if line.get_label() == "free")
    assert np.asarray(line.get_xdata()).tolist() == [0, 1]  # of the width
    labels = frequency.get_legend_handles_labels()[1]
    assert labels == ["free"]


@pytest.mark.parametrize(
    ("values", "ticks"),
    [
        ([0.3, 2.0, 4.0], ["0.5", "1", "2"]),
        ([0.0, 0.2, 5.0], ["0", "0.2", "0.5", "1", "2", "5"]),
        ([0.0, 3e-4, 0.03], ["0", "0.001", "0.01"]),
        ([0.0, 1e-3, 4.0], ["0", "0.001", "0.01", "0.1", "1"]),
    ],
)
def test_a_parameter_over_few_decades_has_several_ticks(
    values: list[float], ticks: list[str]
) -> None:
    poles_of = poles(-1 + 100j, -2 + 100j, -3 + 100j)

    figure = poles_figure(
        values, poles_of, {"free": poles_of, "stuck": poles_of}, SPAN, "limit", ""
    )

    for axes in figure.axes[:2]:
        assert [label.get_text() for label in axes.get_xticklabels()] == ticks


def test_damping_of_one_decade_has_plain_numbers() -> None:
    pole = poles(-1 + 100j, -6 + 100j)

    figure = poles_figure(
        [1.0, 2.0], pole, {"free": pole, "stuck": pole}, SPAN, "limit", ""
    )

    figure.draw_without_rendering()
    labels = [label.get_text() for label in figure.axes[1].get_yticklabels()]
    assert {"1", "2", "5"} <= set(labels)


def test_frequencies_that_do_not_change_have_a_readable_axis() -> None:
    hertz = [135.0, 135.0 + 3e-14]
    flat = ModeLine("mode", [1e-3, 2e-3], hertz, [0.01, 0.01])
    peaks = [(0.0, hertz[0], 1e-3), (1.0, hertz[1], 1e-3)]

    mode, _ = modes_figure([flat], "").axes
    _, tracked = track_figure(peaks, [], "model", "", ["A", "B"], 0.006).axes

    assert np.ptp(mode.get_ylim()) == pytest.approx(1.1 * 1e-6 * 135.0, rel=1e-3)
    assert np.ptp(tracked.get_ylim()) == pytest.approx(1.1 * 0.012, rel=1e-3)


def test_a_decay_of_one_frequency_does_not_show_rounding(
    small_history: TimeHistory,
) -> None:
    hertz = np.array([19.4921763, 19.4921767, 19.4921763])
    size = np.array([1e-3, 1e-4, 1e-5])
    decay = RingDown(np.arange(3.0), size, math.tau * hertz, *[np.full(3, 0.004)] * 2)

    frequency = decay_figure(small_history, decay, 0, "").axes[2]

    assert np.ptp(frequency.get_ylim()) == pytest.approx(1.1e-6 * hertz[0], rel=1e-3)


def test_a_decay_that_does_not_decay_does_not_show_rounding(
    small_history: TimeHistory,
) -> None:
    away = 1e-12 * np.array([1.0, -1.0, 1.0])
    decay = RingDown(np.arange(3.0), 2e-3 * (1.0 + away), 100.0 + away, away, away)

    _, shrinking, frequency, damping = decay_figure(small_history, decay, 0, "").axes

    for limits in (shrinking.get_ylim(), frequency.get_xlim(), damping.get_xlim()):
        assert np.ptp(limits) == pytest.approx(1.1e-6 * 2.0, rel=1e-3)
    assert np.ptp(damping.get_ylim()) > 1e-4
