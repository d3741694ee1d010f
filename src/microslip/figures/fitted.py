"""Legends and titles of panels that fit into them, and cover nothing."""

from __future__ import annotations

import itertools
import textwrap
from collections.abc import Iterator
from typing import Literal

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.lines import Line2D
from matplotlib.text import Text
from matplotlib.transforms import Bbox

from microslip_mechanics.arrays import Array

Corner = Literal["upper left", "upper right"]
WIDE = 1.04
"""width of a title over that of its panel, from which on it takes more lines"""
TALLEST = 0.7
"""share of a panel that a legend above lines may take"""
GAP = 0.02
"""share of a panel between such a legend and the lines"""
INSIDE, OUTSIDE = 0.8, 0.5
"""height of a legend's margins, and of what is above it, over that of its letters"""
POINTS = 72.0
"""in an inch"""
CORNERS: dict[Corner, float] = {"upper left": 0.0, "upper right": 1.0}
"""where it may be: in which share of the panel's width"""


def fitted(figure: Figure) -> None:
    """Break titles that are wider than their panels; uncover lines below legends.

    Where a legend would lie on a line, its panel is stretched until there is space for
    it above the lines, in the corner and with the columns that take the least. The
    picture must be complete but for its own title.
    """
    figure.draw_without_rendering()
    for axes in figure.axes:
        _break_title(axes)
        legend = axes.get_legend()
        if legend is None or not legend.get_texts():
            continue
        if _covers(axes, legend.get_window_extent()):
            _lift(axes, legend)


def _break_title(axes: Axes) -> None:
    """Write the title over as many lines as it takes."""
    words = axes.get_title(loc="left")
    for text in axes.get_children():
        if words and isinstance(text, Text) and text.get_text() == words:
            width = text.get_window_extent().width / axes.bbox.width
            if width > WIDE:
                text.set_text(textwrap.fill(words, max(1, int(len(words) / width))))


def _covers(axes: Axes, box: Bbox) -> bool:
    """Return whether something that is drawn passes through a box of the display."""
    areas = (path for area in axes.collections for path in area.get_paths())
    return any(_passes(line, box) for line in axes.lines) or any(
        axes.transData.transform_path(path).intersects_bbox(box) for path in areas
    )


def _passes(line: Line2D, box: Bbox) -> bool:
    """Return whether a line, or a mark of one without a line, is in a box."""
    path = line.get_transform().transform_path(line.get_path())
    if line.get_linestyle() == "None":
        return any(box.contains(x, y) for x, y in np.asarray(path.vertices))
    return bool(path.intersects_bbox(box, filled=False))


def _lift(axes: Axes, legend: Legend) -> None:
    """Put a legend where its panel must be stretched least to have it above lines."""
    box, count = legend.get_window_extent(), len(legend.get_texts())
    panel, most = axes.bbox, int(axes.bbox.width / box.width)
    found: list[tuple[float, int, Corner]] = []
    for columns, (corner, side) in itertools.product(
        range(1, max(1, min(count, most)) + 1), CORNERS.items()
    ):
        width = columns * box.width / panel.width
        height = _height(legend, -(-count // columns)) / panel.height + GAP
        left = side * (1.0 - width)
        top = max(_tops(axes, left, left + width), default=0.0)
        stretch = max(1.0, top / (1.0 - min(TALLEST, height)))
        found.append((stretch, columns, corner))
    stretch, columns, corner = min(found)
    scale = axes.yaxis.get_transform()
    low, high = scale.transform(axes.get_ylim())
    axes.set_ylim(top=float(scale.inverted().transform(low + stretch * (high - low))))
    texts = legend.get_texts()
    handles = [handle for handle in legend.legend_handles if handle is not None]
    axes.legend(
        handles, [text.get_text() for text in texts], frameon=False, ncols=columns,
        fontsize=texts[0].get_fontsize(), loc=corner,
    )  # fmt: skip


def _height(legend: Legend, rows: int) -> float:
    """Return how far down a legend of so many rows reaches [pixels]."""
    letters = legend.prop.get_size_in_points() * legend.axes.figure.dpi / POINTS
    margin, count = INSIDE * letters, len(legend.get_texts())
    row = (legend.get_window_extent().height - margin) / count
    return rows * row + margin + OUTSIDE * letters


def _tops(axes: Axes, left: float, right: float) -> Iterator[float]:
    """Yield how high lines and areas come between two shares of a panel's width."""
    paths = [
        line.get_transform().transform_path(line.get_path()) for line in axes.lines
    ]
    paths += [
        axes.transData.transform_path(path)
        for area in axes.collections
        for path in area.get_paths()
    ]
    for path in paths:
        places: Array = axes.transAxes.inverted().transform(path.vertices)
        first, last = np.vstack([places, places[:-1]]), np.vstack([places, places[1:]])
        across = np.maximum(first[:, 0], last[:, 0]) >= left
        across &= np.minimum(first[:, 0], last[:, 0]) <= right
        yield float(np.maximum(first, last)[across, 1].max(initial=0.0))
