"""Pictures of nonlinear modes: frequency and damping against amplitude."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.figure import Figure

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


def modes_figure(lines: Sequence[ModeLine], title: str) -> Figure:
    """Draw natural frequency and damping ratio of modes against amplitude."""
    figure = Figure(figsize=(10.0, 4.2), layout="constrained")
    left, right = figure.subplots(1, 2)
    for place, line in enumerate(lines):
        style = {
            "color": COLOURS[place % len(COLOURS)],
            "linewidth": WIDTH,
            "label": line.name,
        }
        millimetres = [1e3 * amplitude for amplitude in line.amplitude]
        left.plot(millimetres, line.frequency, **style)
        right.plot(millimetres, [100.0 * ratio for ratio in line.damping], **style)
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
    if len(lines) > 1:
        right.legend(frameon=False)
    headline(figure, title)
    return figure
