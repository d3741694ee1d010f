"""Pictures of how peaks and bifurcations move with a parameter."""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.amplitude import MARKERS
from microslip.figures.fitted import fitted
from microslip.figures.style import (
    COLOURS,
    SHORT,
    WIDTH,
    framed,
    headline,
    literal,
    plain_logarithmic,
    widened,
)

MANY = 10
"""values up to which each may have its own tick"""
LETTER = 0.021
"""width of a letter of a tick's label, over the axis"""


def track_figure(
    peaks: Sequence[tuple[float, float, float]],
    others: Sequence[tuple[float, str, float]],
    key: str,
    title: str,
    names: Sequence[str] = (),
    error: float = 0.0,
    otherwise: Sequence[tuple[float, float]] = (),
) -> Figure:
    """Draw amplitude and frequency of the highest peak, and the other events.

    Parameters
    ----------
    peaks
        Value of the parameter, frequency [Hz] and amplitude [m] of each.
    others
        Value of the parameter, name of the event, frequency [Hz].
    key, title
        What the parameter and the picture are called.
    names
        Of values that are no numbers: no line joins these.
    error
        Of the frequencies, estimated [Hz]: what differs by less is not told apart.
    otherwise
        Value of the parameter and amplitude [m] where other residual tractions allow
        more than the highest peak.
    """
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2, sharex=True)
    peaks = sorted(peaks)
    places = {value for value, *_ in (*peaks, *others)}
    line = {"color": COLOURS[0], "linewidth": 0.0 if names else WIDTH}
    _draw_peaks(left, peaks, otherwise, line)
    _draw_frequencies(right, peaks, others, line)
    for axes in (left, right):
        _abscissa(axes, sorted(places) or [1.0], names)
    right.ticklabel_format(axis="y", useOffset=False)
    widened(right, error)
    framed(left, x=literal(key), y="amplitude [mm]", title="Highest peak")
    _amplitudes(left, [1e3 * each[-1] for each in (*peaks, *otherwise)])
    framed(right, x=literal(key), y="frequency [Hz]", title="Where it happens")
    right.legend(frameon=False)
    for axes in (left, right):
        axes.margins(x=0.04)
    fitted(figure)
    headline(figure, title)
    return figure


def _draw_peaks(
    axes: Axes,
    peaks: Sequence[tuple[float, float, float]],
    otherwise: Sequence[tuple[float, float]],
    line: dict[str, Any],
) -> None:
    """Draw the amplitude of the highest peak."""
    places = [value for value, *_ in peaks]
    axes.plot(places, [1e3 * amplitude for *_, amplitude in peaks], "-^", **line)
    if otherwise:
        at, most = zip(*otherwise, strict=True)
        axes.plot(
            at, [1e3 * each for each in most], "v",
            color=COLOURS[0], fillstyle="none", label="with other residual tractions",
        )  # fmt: skip
        axes.legend(frameon=False)


def _draw_frequencies(
    axes: Axes,
    peaks: Sequence[tuple[float, float, float]],
    others: Sequence[tuple[float, str, float]],
    line: dict[str, Any],
) -> None:
    """Draw where the highest peak is, and the other events."""
    places = [value for value, *_ in peaks]
    hertz = [frequency for _, frequency, _ in peaks]
    axes.plot(places, hertz, "-^", label="highest peak", **line)
    for kind, marker in MARKERS.items():
        seen = [(value, found) for value, name, found in others if name == kind]
        if seen:
            axes.plot(
                *zip(*seen, strict=True),
                marker,
                color="0.15",
                fillstyle="none",
                label=kind,
            )


def _amplitudes(axes: Axes, sizes: Sequence[float]) -> None:
    """Scale the axis of the amplitude, like the parameter's where it spans much."""
    least, most = min(sizes, default=0.0), max(sizes, default=0.0)
    if axes.get_xscale() == "log" and most > SHORT * least > 0.0:
        axes.set_yscale("log")
        plain_logarithmic(axes.yaxis)
    else:
        axes.set_ylim(0.0, 1.06 * most or None)


def _abscissa(axes: Axes, values: Sequence[float], names: Sequence[str]) -> None:
    """Scale the axis of the parameter, and label it with values or names."""
    if min(values) > 0.0 and max(values) > 10.0 * min(values):
        axes.set_xscale("log")
    if names:
        axes.set_xticks(range(len(names)), [literal(name) for name in names])
    else:
        _ticks(axes, values)


def _ticks(axes: Axes, values: Sequence[float]) -> None:
    """Set a tick at each value, or usual ones where their labels would not fit."""
    logarithmic, labels = axes.get_xscale() == "log", _labels(values)
    if len(values) <= MANY and _fit(values, labels, logarithmic=logarithmic):
        axes.set_xticks(list(values), labels)
        axes.set_xticks([], minor=True)
    elif logarithmic:
        plain_logarithmic(axes.xaxis)


def _labels(values: Sequence[float]) -> list[str]:
    """Return the labels of values, with as many digits as tell them apart."""
    for digits in range(6, 17):
        labels = [f"{value:.{digits}g}" for value in values]
        if len(set(labels)) == len(set(values)):
            break
    return labels


def _fit(values: Sequence[float], labels: Sequence[str], *, logarithmic: bool) -> bool:
    """Return whether a label fits at each of the values, which increase."""
    places = [math.log(value) if logarithmic else value for value in values]
    length = (places[-1] - places[0]) or 1.0
    halves = [0.5 * LETTER * len(label) for label in labels]
    return all(
        (after - before) / length >= left + right + LETTER
        for (before, after), (left, right) in zip(
            itertools.pairwise(places), itertools.pairwise(halves), strict=True
        )
    )
