"""Pictures of poles against a parameter."""

from __future__ import annotations

import itertools
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import NDArray

from microslip.figures.fitted import fitted
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    headline,
    literal,
    plain_logarithmic,
    widened,
)
from microslip_mechanics.arrays import Array, ComplexArray

LIMITS = {"free": ":", "stuck": "--"}
"""lines of the poles without friction and without sliding"""
BESIDE = 0.3
"""half the length of a limit at a value without neighbours"""
ROUNDING = 1e-9
"""of the ends of an axis: a tick there belongs to it"""
LETTERS = 28
"""of ticks that a panel has room for"""
NOTHING = complex(np.nan, np.nan)


def poles_figure(
    places: Sequence[float],
    branches: ComplexArray,
    limits: Mapping[str, ComplexArray],
    span: tuple[float, float],
    key: str,
    title: str,
    names: Sequence[str] = (),
) -> Figure:
    """Draw frequency and damping against the parameter, and the paths of the poles.

    Parameters
    ----------
    places
        Values of the parameter, shape (values,).
    branches
        Poles [rad/s], shape (values, branches); NaN where there is none.
    limits
        The same without friction ("free") and without sliding ("stuck").
    span
        Range that the frequencies must be in to be shown [rad/s].
    key, title
        What the parameter and the picture are called.
    names
        Of values that are no numbers: no line joins these.
    """
    figure = Figure(figsize=(12.0, 4.2), layout="constrained")
    frequency, damping, path = figure.subplots(1, 3)
    order = np.argsort(places, kind="stable")
    where = np.array(places, dtype=float)[order]
    shown = np.where(_inside(branches, span), branches, NOTHING)[order]
    for number, branch in enumerate(shown.T):
        colour = COLOURS[number % len(COLOURS)]
        line = {
            "color": colour,
            "linewidth": 1.5 * WIDTH,
            "marker": "o",
            "markersize": 3.0,
        }
        line["linestyle"] = "" if names else "-"
        frequency.plot(where, _hertz(branch), **line)
        damping.plot(where, _ratio(branch), **line)
        path.plot(_positive(-branch.real), _hertz(branch), **line)
    for name in LIMITS:
        lines = np.where(_inside(limits[name], span), limits[name], NOTHING)[order]
        for axes, heights in ((frequency, _hertz(lines)), (damping, _ratio(lines))):
            _limit(axes, where, heights, name, apart=bool(names))
    _finish(frequency, damping, path, where, key, names)
    for axes in (frequency, path):
        axes.ticklabel_format(axis="y", useOffset=False)
        widened(axes)
    fitted(figure)
    headline(figure, title)
    return figure


def _limit(axes: Axes, where: Array, heights: Array, name: str, *, apart: bool) -> None:
    """Draw a limit against the parameter: a line, or one beside each value."""
    line: dict[str, Any] = {"color": "0.35", "linewidth": WIDTH}
    line["linestyle"] = LIMITS[name]
    drawn: list[Line2D] = []
    if where.size > 1 and not apart:
        drawn = axes.plot(where, heights, **line)
    elif apart:
        for place, row in zip(where, heights, strict=True):
            ends = place - BESIDE, place + BESIDE
            drawn += [axes.plot(ends, [y, y], **line)[0] for y in row[np.isfinite(row)]]
    else:
        drawn = [axes.axhline(y, **line) for y in heights[np.isfinite(heights)]]
    if np.isfinite(heights).any():
        drawn[0].set_label(name)


def _finish(
    frequency: Axes,
    damping: Axes,
    path: Axes,
    where: Array,
    key: str,
    names: Sequence[str],
) -> None:
    """Scale, name and frame the panels."""
    damping.set_yscale("log")
    path.set_xscale("log")
    framed(frequency, x=literal(key), y="frequency [Hz]", title="Free decay")
    framed(damping, x=literal(key), y="damping ratio [%]", title="Damping")
    framed(
        path, x="rate of decay [1/s]", y="frequency [Hz]", title="Paths of the poles"
    )
    for axes in (frequency, damping):
        if names:
            axes.set_xticks(range(len(names)), [literal(name) for name in names])
        else:
            _scale(axes, where)
        if axes.get_legend_handles_labels()[0]:
            axes.legend(frameon=False)
    for axes in (frequency, damping, path):
        axes.margins(x=0.04)
    for axis in (damping.yaxis, path.xaxis):
        plain_logarithmic(axis)


def _scale(axes: Axes, where: Array) -> None:
    """Choose a logarithmic parameter where it spans decades; zero stays beside it."""
    positive = where[where > 0.0]
    if positive.size and where.min() >= 0.0 and where.max() > 10.0 * positive.min():
        axes.set_xscale("symlog", linthresh=positive.min(), linscale=0.5)
        shown = _ticks(positive.min(), where.max())
        ticks = [0.0, *shown] if where.min() == 0.0 else shown
        axes.set_xticks(ticks, [f"{tick:g}" for tick in ticks])
        axes.set_xticks([], minor=True)


def _ticks(low: float, high: float) -> list[float]:
    """Return 1, 2, 5 and so on between the ends, as many as have room for labels."""
    decades = 10.0 ** np.arange(np.floor(np.log10(low)), np.log10(high) + 1.0)
    ends = low * (1.0 - ROUNDING), high * (1.0 + ROUNDING)
    found: list[float] = []
    for steps in ((1.0, 2.0, 5.0), (1.0, 3.0), (1.0,)):
        marks = np.outer(decades, steps).ravel()
        found = [float(each) for each in marks if ends[0] <= each <= ends[1]]
        longest = max((len(f"{each:g}") for each in found), default=0)
        closest = min((b / a for a, b in itertools.pairwise(found)), default=np.inf)
        if np.log10(closest) * LETTERS >= (longest + 1) * np.log10(high / low):
            break
    return found


def _inside(values: ComplexArray, span: tuple[float, float]) -> NDArray[np.bool_]:
    with np.errstate(invalid="ignore"):
        inside: NDArray[np.bool_] = (values.imag >= span[0]) & (values.imag <= span[1])
    return inside


def _hertz(values: ComplexArray) -> Array:
    return values.imag / (2.0 * np.pi)


def _ratio(values: ComplexArray) -> Array:
    """Return damping ratios [%]."""
    return _positive(-100.0 * values.real / np.abs(values))


def _positive(values: Array) -> Array:
    """Return what a logarithmic axis can show, the rest as NaN."""
    return np.where(values > 0.0, values, np.nan)
