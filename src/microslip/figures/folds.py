"""Pictures of how folds move with a parameter."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.abscissa import over_decades
from microslip.figures.fitted import fitted
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    headline,
    literal,
    plain_logarithmic,
    whole_numbers,
)

MEETINGS = {"cusp": "o", "isola": "D"}
"""markers of the places where folds or curves meet"""


@dataclass(frozen=True, slots=True)
class FoldLine:
    """One fold, point by point."""

    parameter: Sequence[float]
    """in SI units"""
    frequency: Sequence[float]
    """[Hz]"""
    amplitude: Sequence[float]
    """[m]"""
    unstable: Sequence[bool]
    """whether no stable motion ends there"""
    event: Sequence[str]
    """cusp, isola, or empty"""


def folds_figure(folds: Sequence[FoldLine], label: str, title: str) -> Figure:
    """Draw frequency and amplitude of folds against a parameter.

    Folds at which no stable motion ends are dotted.
    """
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    for place, fold in enumerate(folds):
        colour = COLOURS[place % len(COLOURS)]
        _drawn(left, fold, fold.frequency, colour)
        _drawn(right, fold, [1e3 * each for each in fold.amplitude], colour)
    framed(left, x=literal(label), y="frequency [Hz]", title="Where the curve folds")
    framed(right, x=literal(label), y="amplitude [mm]", title="Amplitude at the fold")
    for axes in (left, right):
        whole_numbers(axes.yaxis)
        axes.margins(x=0.04)
        if over_decades(np.concatenate([fold.parameter for fold in folds])):
            axes.set_xscale("log")
            plain_logarithmic(axes.xaxis)
    _legend(left, folds)
    if len(folds) > 1:
        _names(right, len(folds))
    fitted(figure)
    headline(figure, title)
    return figure


def _drawn(axes: Axes, fold: FoldLine, values: Sequence[float], colour: str) -> None:
    """Draw one fold, solid where a stable motion ends, with what happens on it."""
    unstable = np.array(fold.unstable, dtype=bool)
    # a piece is as stable as the less stable of its ends
    dotted = unstable.copy()
    dotted[:-1] |= unstable[1:]
    dotted[1:] |= unstable[:-1]
    known = np.array(values, dtype=float)
    for shown, style in ((~unstable, "-"), (dotted, ":")):
        axes.plot(
            fold.parameter,
            np.where(shown, known, np.nan),
            style,
            color=colour,
            linewidth=WIDTH,
        )
    for name, marker in MEETINGS.items():
        places = [place for place, event in enumerate(fold.event) if event == name]
        axes.plot(
            [fold.parameter[place] for place in places],
            known[places],
            marker,
            color="0.15",
            fillstyle="none",
        )


def _names(axes: Axes, count: int) -> None:
    """Name the folds by their colours, by the numbers that the table has."""
    handles = []
    for place, colour in enumerate(COLOURS[:count]):
        numbers = [str(each) for each in range(place + 1, count + 1, len(COLOURS))]
        name = f"fold{'s' if len(numbers) > 1 else ''} {', '.join(numbers)}"
        handles += axes.plot([], [], color=colour, linewidth=WIDTH, label=name)
    axes.legend(handles=handles, frameon=False)


def _legend(axes: Axes, folds: Sequence[FoldLine]) -> None:
    """Say what lines and markers mean, of those that there are."""
    lines, handles = [], []
    if not all(all(fold.unstable) for fold in folds):
        lines.append(("-", "a stable motion ends"))
    if any(any(fold.unstable) for fold in folds):
        lines.append((":", "unstable on both sides"))
    for form, text in lines:
        handles += axes.plot([], [], form, color="0.15", linewidth=WIDTH, label=text)
    for name, marker in MEETINGS.items():
        if any(name in fold.event for fold in folds):
            handles += axes.plot(
                [], [], marker, color="0.15", fillstyle="none", label=name
            )
    axes.legend(handles=handles, frameon=False)
