"""What the tests of pictures look at: lines, legends, labels with units."""

import dataclasses
import re
from collections.abc import Iterable, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from numpy.typing import ArrayLike

from microslip_mechanics.results.response_curve import ResponseCurve

UNIT = re.compile(r" \[.+\]$")


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
        assert axes.xaxis.get_major_ticks()[0].label1.get_visible(), title


def unmarked(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve of whose stability and events nothing is known."""
    points = len(curve.event)
    return unique(
        dataclasses.replace(curve, unstable=np.full(points, -1.0), event=("",) * points)
    )


def unique(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve whose amplitudes no residual traction changes."""
    return dataclasses.replace(
        curve, amplitude_lowest=curve.amplitude, amplitude_highest=curve.amplitude
    )
