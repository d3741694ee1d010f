"""Pictures of error against run time."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    headline,
)
from microslip_mechanics.arrays import Array

LOOKS = {
    "harmonic balance": (COLOURS[0], "o", "-"),
    "harmonic balance by tolerance": (COLOURS[5], "s", "-"),
    "reference march": (COLOURS[1], "D", "-"),
    "fast march": (COLOURS[4], "^", "-"),
    "fast march by tolerance": (COLOURS[3], "v", "-"),
    "shooting": (COLOURS[2], "P", "-"),
    "scipy Radau": ("0.15", "*", "--"),
    "scipy BDF": ("0.4", "X", "--"),
    "scipy LSODA": ("0.6", "h", "--"),
}
"""colour, marker and line of each method; outsiders are grey"""
TITLES = {
    "amplitude": "Peak amplitude",
    "energy": "Energy per period",
    "distance": "Distance of orbits",
}
EXPLAINED = (
    "A mark is one motion found with one setting; the lines join the best of each "
    "method, whose error falls like one over time to the power of the slope.\n"
    "Down and to the left is better."
)
GREY = " Within the grey the reference itself is not known."
LOWEST = 1e-12
"""error as which smaller ones are drawn"""
BELOW = f" Errors below {LOWEST:g} are drawn there."
REACH = 1e-3
"""of the smallest error, down to which an axis goes to show the grey"""


@dataclass(frozen=True, slots=True)
class Line:
    """All complete runs of one method."""

    seconds: Array
    """shape (runs,)"""
    errors: Array
    """of each quantity, shape (runs, quantities)"""
    fronts: tuple[Sequence[int], ...]
    """places of the best runs by each quantity, by cost"""
    slopes: tuple[float, ...]
    """exponents by which the errors fall with cost; NaN if not known"""


def precision_figure(
    lines: Mapping[str, Line], doubts: Mapping[str, float], title: str
) -> Figure:
    """Draw the errors over the seconds, a panel for each quantity.

    Parameters
    ----------
    lines
        By the method's name.
    doubts
        By the quantity's name, how well the reference is known, relative.
    title
        What the picture is called.
    """
    figure = Figure(figsize=(13.0, 5.6), layout="constrained")
    panels = figure.subplots(1, len(doubts), sharex=True, sharey=True)
    for place, (axes, (quantity, doubt)) in enumerate(
        zip(panels, doubts.items(), strict=True)
    ):
        for method, line in lines.items():
            _draw(axes, line, place, method)
        axes.set_xscale("log")
        axes.set_yscale("log")
        framed(axes, x="CPU time [s]", y="", title=TITLES[quantity])
        axes.margins(x=0.04)
        _doubt(axes, doubt)
        axes.legend(
            *_slopes(axes, [line.slopes[place] for line in lines.values()]),
            frameon=False,
            fontsize="x-small",
            title="slope",
            title_fontsize="x-small",
            loc="best",
        )
    panels[0].set_ylabel("relative error")
    bottom = _bottom(lines, doubts)
    panels[0].set_ylim(bottom=bottom)
    told = EXPLAINED + (GREY if max(doubts.values()) > bottom else "")
    told += BELOW if _least(lines) < LOWEST else ""
    handles, names = panels[0].get_legend_handles_labels()
    figure.legend(
        handles, names, loc="outside lower center", ncols=4, frameon=False,
        fontsize="small", title=told, title_fontsize="small",
    )  # fmt: skip
    headline(figure, title)
    return figure


def _draw(axes: Axes, line: Line, place: int, method: str) -> None:
    """Draw all runs of a method, and a line through the best."""
    errors = np.maximum(line.errors[:, place], LOWEST)
    colour, marker, style = LOOKS[method]
    look: dict[str, Any] = {"color": colour, "marker": marker, "linewidth": WIDTH}
    axes.plot(line.seconds, errors, linestyle="", markersize=2.0, alpha=0.5, **look)
    best = list(line.fronts[place])
    axes.plot(
        line.seconds[best], errors[best], style, markersize=4.5, label=method, **look
    )


def _doubt(axes: Axes, doubt: float) -> None:
    """Grey out what the reference cannot tell."""
    axes.axhspan(0.0, max(doubt, LOWEST), color="0.9", zorder=0.0)


def _slopes(axes: Axes, slopes: Sequence[float]) -> tuple[list[object], list[str]]:
    """Return handles and texts of the slopes that are known."""
    handles, _ = axes.get_legend_handles_labels()
    known = [
        (handle, f"{slope:.1f}")
        for handle, slope in zip(handles, slopes, strict=True)
        if not np.isnan(slope)
    ]
    return [handle for handle, _ in known], [text for _, text in known]


def _bottom(lines: Mapping[str, Line], doubts: Mapping[str, float]) -> float:
    """Return where the axis of errors begins: below all marks, and in the grey."""
    least = max(LOWEST, _least(lines))
    doubt = max(LOWEST, min(doubts.values()))
    return 0.3 * (min(least, doubt) if doubt >= REACH * least else least)


def _least(lines: Mapping[str, Line]) -> float:
    """Return the smallest error, zero if a run is exact."""
    return float(min((line.errors.min() for line in lines.values()), default=LOWEST))
