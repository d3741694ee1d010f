"""Picture of a free decay: the motion, its frequency and its damping by amplitude."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.fitted import fitted
from microslip.figures.names import readable
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    headline,
    plain_logarithmic,
    spread,
    widened,
)
from microslip_mechanics.results.ring_down import RingDown
from microslip_mechanics.results.time_history import TimeHistory

ROUNDING = 1e-4
"""damping ratio [%] that a picture does not enlarge"""


def decay_figure(
    history: TimeHistory, decay: RingDown, probe: int, title: str
) -> Figure:
    """Draw one probe in time, its amplitude, and frequency and damping against it."""
    figure = Figure(figsize=(10.0, 7.0), layout="constrained")
    (motion, shrinking), (frequency, damping) = figure.subplots(2, 2)
    name = readable(history.probes[probe])
    moved = 1e3 * history.displacement[:, probe]
    motion.plot(history.time, moved, color=COLOURS[0], lw=0.2, rasterized=True)
    framed(motion, x="time [s]", y="displacement [mm]", title=f"Free decay, {name}")
    millimetres = 1e3 * decay.amplitude
    line = {"color": COLOURS[0], "linewidth": WIDTH * 1.5}
    shrinking.plot(decay.time, millimetres, **line)
    framed(shrinking, x="time [s]", y="amplitude [mm]", title="Amplitude")
    frequency.plot(millimetres, decay.frequency / math.tau, **line)
    framed(frequency, x="amplitude [mm]", y="natural frequency [Hz]", title="Frequency")
    frequency.ticklabel_format(axis="y", useOffset=False)
    widened(frequency)
    _damping(damping, decay)
    if (decay.amplitude > 0.0).all() and decay.amplitude.size:
        _by_decades(shrinking, frequency, damping)
    fitted(figure)
    headline(figure, title)
    return figure


def _damping(axes: Axes, decay: RingDown) -> None:
    """Draw both damping ratios against the amplitude."""
    millimetres = 1e3 * decay.amplitude
    for ratio, style, color, label in (
        (decay.damping, "-", COLOURS[0], "by amplitude"),
        (decay.energy_damping, "--", COLOURS[1], "by energy, as modes have it"),
    ):
        if not ratio.size:
            continue
        axes.plot(
            millimetres, 100.0 * ratio, style, color=color, lw=1.5 * WIDTH, label=label
        )
    framed(axes, x="amplitude [mm]", y="damping ratio [%]", title="Damping")
    axes.legend(frameon=False)
    if (decay.damping > 0.0).all():
        both = np.append(decay.damping, decay.energy_damping)
        highest = np.nanmax(both, initial=1e-9)
        axes.set_ylim(0.0, 108.0 * highest)
    else:
        widened(axes, ROUNDING)


def _by_decades(shrinking: Axes, frequency: Axes, damping: Axes) -> None:
    """Let amplitudes have logarithmic axes, on which rounding is not seen."""
    low, high = shrinking.dataLim.intervaly
    limits = spread(low, high)
    shrinking.set_yscale("log")
    if limits is not None:
        shrinking.set_ylim(*limits)
    plain_logarithmic(shrinking.yaxis)
    for axes in (frequency, damping):
        axes.set_xscale("log")
        if limits is not None:
            axes.set_xlim(*limits)
        plain_logarithmic(axes.xaxis)
