"""Pictures of nonlinear modes: frequency and damping against amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.fitted import fitted
from microslip.figures.style import (
    COLOURS,
    SHORT,
    WIDTH,
    framed,
    headline,
    plain_logarithmic,
    widened,
)


@dataclass(frozen=True, slots=True)
class ModeLine:
    """One mode, point by point."""

    name: str
    amplitude: Sequence[float]
    """[m]"""
    frequency: Sequence[float]
    """[Hz]"""
    damping: Sequence[float]
    """ratio"""
    error: float = 0.0
    """of the frequencies, estimated, in the median [Hz]: a few may be hardly known"""
    coarser: int | None = None
    """place from which on it is drawn as another line"""
    coarse: str = ""
    """what is said of that line"""


def modes_figure(lines: Sequence[ModeLine], title: str) -> Figure:
    """Draw natural frequency and damping ratio of modes against amplitude."""
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    for place, line in enumerate(lines):
        colour = COLOURS[place % len(COLOURS)]
        _draw(left, line, line.frequency, 1.0, colour)
        _draw(right, line, line.damping, 100.0, colour)
    below = "amplitude of the highest probe [mm]"
    framed(left, x=below, y="natural frequency [Hz]", title="Frequency")
    framed(right, x=below, y="damping ratio [%]", title="Damping")
    amplitudes = [amplitude for line in lines for amplitude in line.amplitude]
    if max(amplitudes, default=0.0) > SHORT * min(amplitudes, default=0.0) > 0.0:
        for axes in (left, right):
            axes.set_xscale("log")
            plain_logarithmic(axes.xaxis)
    left.ticklabel_format(axis="y", useOffset=False)
    widened(left, max((line.error for line in lines), default=0.0))
    ratios = [ratio for line in lines for ratio in line.damping]
    if ratios and min(ratios) > 0.0:
        right.set_ylim(0.0, 108.0 * max(ratios))
    if len(lines) > 1 or any(line.coarse for line in lines):
        right.legend(frameon=False)
    fitted(figure)
    headline(figure, title)
    return figure


def _draw(
    axes: Axes, line: ModeLine, values: Sequence[float], scale: float, colour: str
) -> None:
    """Draw values of a mode against amplitude, dashed where it is coarser."""
    across = [1e3 * amplitude for amplitude in line.amplitude]
    along = [scale * value for value in values]
    end = line.coarser
    axes.plot(across[:end], along[:end], color=colour, linewidth=WIDTH, label=line.name)
    if end is not None:
        (drawn,) = axes.plot(across[end:], along[end:], label=line.coarse)
        drawn.set(color=colour, linewidth=WIDTH, linestyle="--")
