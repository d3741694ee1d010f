"""What all pictures share: colours, units of display, the frame around the data."""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import (
    FuncFormatter,
    LogFormatterSciNotation,
    LogLocator,
    MaxNLocator,
    NullLocator,
    ScalarFormatter,
)

from microslip_mechanics.arrays import Array

COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9")
"""Okabe and Ito's palette: told apart by colour-blind readers too"""
WIDTH = 0.9
"""of lines [pt]"""
HIDDEN = 1e-2
"""of the largest value, by which a curve must differ from another to be seen"""
WIDTHS, CROWD = 200, 20
"""of lines in an axis, about, and rows in one from which on its lines are an area"""
STYLES = ("-", "--", ":", "-.")
"""lines that lie on one another stay apart"""
FLAT = 1e-6
"""of its data, that an axis shows at least: less is rounding"""
NARROW = 1e-3
"""of its data, below which what an axis spans takes long numbers"""
LETTERS = 11.0
"""of a title in an inch"""
ROOM = 1.04
"""end of an axis that begins at zero, over its data, at least"""
LONG = 150.0
"""end of a logarithmic axis over its beginning, from which on it has powers of ten"""
SHORT = 5.0
"""the same up to which it would have hardly a number: evenly divided it says more"""
FEW = 4
"""names of a legend up to which two columns are enough"""
EARLY, HIGH = 0.4, 0.5
"""share of the rows, and of the height, that a legend at the upper left may cover"""


def framed(axes: Axes, *, x: str, y: str, title: str) -> None:
    """Label axes and title, thin the frame, start a light grid."""
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.set_title(title, loc="left", fontsize="medium")
    axes.spines[["top", "right"]].set_visible(False)
    axes.margins(x=0.0)
    axes.grid(visible=True, linewidth=0.3, alpha=0.6)
    whole_numbers(axes.xaxis)


def whole_numbers(axis: Axis) -> None:
    """Let an axis have no offset beside it, and few numbers where they are long."""
    formatter = axis.get_major_formatter()
    if not isinstance(formatter, ScalarFormatter):
        return
    formatter.set_useOffset(False)
    low, high = axis.get_data_interval()
    if 0.0 < high - low < NARROW * max(abs(low), abs(high)):
        axis.set_major_locator(MaxNLocator(nbins=4))


def widened(axes: Axes, error: float = 0.0) -> None:
    """Widen a vertical axis that would show nothing but the ``error`` of its data.

    It has no offset beside it, either.
    """
    whole_numbers(axes.yaxis)
    low, high = axes.dataLim.intervaly
    limits = spread(low, high, error)
    if limits is not None:
        axes.set_ylim(*limits)


def spread(low: float, high: float, error: float = 0.0) -> tuple[float, float] | None:
    """Return limits about data that hardly change; None if they are not needed."""
    if not np.isfinite([low, high]).all():
        return None
    least = max(2.0 * error, FLAT * max(abs(low), abs(high)))
    if high - low >= least:
        return None
    middle = 0.5 * (low + high)
    return middle - 0.55 * least, middle + 0.55 * least


def from_nothing(axes: Axes) -> None:
    """Let a vertical axis begin at zero, and what hardly changes not lie on its end."""
    high = axes.get_ylim()[1]
    axes.set_ylim(0.0, max(high, ROOM * float(axes.dataLim.y1)))


def plain_logarithmic(axis: Axis) -> None:
    """Label a logarithmic axis with plain numbers: 0.1, 0.2, 0.5 and so on.

    With powers of ten where it is long, and evenly where it is short; where it is
    narrow, with as many digits as tell numbers apart.
    """
    low, high = axis.get_view_interval()
    if high > LONG * low > 0.0:
        axis.set_major_locator(LogLocator(numticks=8))
        axis.set_major_formatter(LogFormatterSciNotation())
    else:
        narrow = 0.0 < high - low < NARROW * high
        digits = 3 - math.floor(math.log10((high - low) / high)) if narrow else 6
        even = MaxNLocator(nbins=3 if narrow else 5)
        short = high <= SHORT * low
        axis.set_major_locator(even if short else LogLocator(subs=(1.0, 2.0, 5.0)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.{digits}g}"))
    axis.set_minor_locator(NullLocator())


def legend_beside(axes: Axes, columns: Array) -> None:
    """Put the legend at the upper left, above lines that begin too high for it.

    ``columns`` are what they show from left to right, shape (rows, lines).
    """
    low, high = axes.get_ylim()
    begin = columns[: max(1, int(EARLY * len(columns)))]
    if begin.max(initial=low) > low + HIGH * (high - low):
        legend_above(axes)
        return
    axes.legend(frameon=False, loc="upper left")


def one_range(columns: Iterable[Array]) -> tuple[float, float]:
    """Return limits that hold all columns: about zero, if they are nearly about it."""
    ends = [
        (float(each.min(initial=0.0)), float(each.max(initial=0.0))) for each in columns
    ]
    low = min((low for low, _ in ends), default=0.0)
    high = max((high for _, high in ends), default=0.0)
    limit = 1.05 * (max(-low, high) or 1e-9)
    if 2.0 * min(-low, high) >= max(-low, high):
        return -limit, limit
    room = 0.05 * (high - low)
    return low - room, high + room


def legend_above(axes: Axes) -> None:
    """Put the legend, if there is any, above the lines in space made for it."""
    count = len(axes.get_legend_handles_labels()[0])
    columns = 2 if count <= FEW else 3
    lines = -(-count // columns)
    if not lines:
        return
    low, high = axes.get_ylim()
    axes.set_ylim(low, high + (0.08 + 0.1 * lines) * (high - low))
    axes.legend(
        frameon=False, loc="upper left", ncols=columns, fontsize="small",
        handlelength=1.6, columnspacing=1.2,
    )  # fmt: skip


def alike(columns: Array, places: Sequence[int]) -> list[list[int]]:
    """Return the places by columns that would be drawn on one another.

    Those differ by less than a line's width: at each row or, where many rows share a
    width, in what they reach from below and above. Shape (rows, columns).
    """
    if len(columns) > CROWD * WIDTHS:
        begins = np.linspace(0, len(columns), WIDTHS, endpoint=False).astype(int)
        reached = (
            np.maximum.reduceat(columns, begins),
            np.minimum.reduceat(columns, begins),
        )
        columns = np.concatenate(reached)
    size = abs(columns[:, list(places)]).max(initial=0.0)
    groups: list[list[int]] = []
    for place in places:
        for group in groups:
            away = abs(columns[:, place] - columns[:, group[0]]).max(initial=0.0)
            if away <= HIDDEN * size:
                group.append(place)
                break
        else:
            groups.append([place])
    return groups


def headline(figure: Figure, title: str) -> None:
    """Write the title of a picture, over as many lines as it takes."""
    letters = int(LETTERS * figure.get_figwidth())
    figure.suptitle(literal(textwrap.fill(title, letters)))


def literal(text: str) -> str:
    """Return a text in which dollars are dollars, not formulas."""
    return text.replace("$", r"\$")
