"""Amplitude against frequency: a line for each way through the range of a sweep."""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes

from microslip.figures.names import readable
from microslip.figures.style import COLOURS, STYLES, WIDTH, framed, legend_above
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory

FEWEST = 4
"""cycles of a way, and rows of a cycle, that can be seen"""
MOST = 12
"""lines that a legend names"""


@dataclass(frozen=True, slots=True)
class Pass:
    """One way of the drive through a range of frequencies."""

    level: float
    rises: bool
    hertz: Array
    """of each cycle [Hz], shape (cycles,)"""
    swing: Array
    """half of the way from lowest to highest [m], shape (cycles, probes)"""


def passes(result: TimeHistory | Envelope) -> list[Pass]:
    """Return the ways of a sweep; none where its cycles cannot be seen."""
    if isinstance(result, Envelope):
        frequency, level, swing = result.frequency, result.level, result.swing
    else:
        frequency, level, swing = _cycles(result)
    found = []
    for first, last in _stretches(frequency, level):
        hertz = frequency[first:last] / (2.0 * np.pi)
        rises = bool(hertz[-1] > hertz[0])
        found.append(Pass(float(level[first]), rises, hertz, swing[first:last]))
    return found


def amplitude(axes: Axes, ways: list[Pass], place: int, probe: str) -> None:
    """Draw the amplitude of one probe along each way."""
    levels = sorted({way.level for way in ways})
    both = len({way.rises for way in ways}) > 1
    named: set[str] = set()
    for number, way in enumerate(ways):
        name = f"level {way.level:g}" if len(levels) > 1 else ""
        direction = ("up" if way.rises else "down") if both else ""
        label = ", ".join(each for each in (name, direction) if each)
        axes.plot(
            way.hertz,
            1e3 * way.swing[:, place],
            STYLES[0] if way.rises else STYLES[1],
            color=COLOURS[(levels.index(way.level) if len(levels) > 1 else number) % 6],
            linewidth=WIDTH,
            label="" if label in named else label,
        )
        named.add(label)
    title = f"Amplitude of each cycle, {readable(probe)}"
    framed(axes, x="frequency [Hz]", y="amplitude [mm]", title=title)
    axes.set_ylim(bottom=0.0)
    if 1 < len(named) <= MOST:
        legend_above(axes)


def _cycles(history: TimeHistory) -> tuple[Array, Array, Array]:
    """Return frequency, level and swing of each cycle; none if rows are too rare.

    Those that the end of the march cuts off, or in which the level changes, as at the
    end of the drive, are left out.
    """
    time, frequency = history.time, history.frequency
    none = np.zeros(0), np.zeros(0), np.zeros((0, len(history.probes)))
    if frequency.size != time.size or time.size < FEWEST:
        return none
    step = np.diff(time, prepend=0.0)
    turns = frequency * step / (2.0 * np.pi)
    if turns[1:].max() > 1.0 / FEWEST:
        return none
    cycle = np.floor(np.cumsum(turns))
    starts = np.flatnonzero(np.diff(cycle, prepend=cycle[0] - 1.0))
    high = np.maximum.reduceat(history.displacement, starts, axis=0)
    low = np.minimum.reduceat(history.displacement, starts, axis=0)
    level = history.level
    whole = np.minimum.reduceat(level, starts) == np.maximum.reduceat(level, starts)
    whole[-1] = False
    seen = starts[whole]
    return frequency[seen], level[seen], 0.5 * (high - low)[whole]


def _stretches(frequency: Array, level: Array) -> list[tuple[int, int]]:
    """Return first and last place of each way, in which the frequency does not turn."""
    if frequency.size < FEWEST:
        return []
    way = np.sign(np.diff(frequency, prepend=frequency[0]))
    for place in range(way.size - 2, -1, -1):
        if way[place] == 0.0 and level[place] == level[place + 1]:
            way[place] = way[place + 1]
    for place in range(1, way.size):
        if way[place] == 0.0 and level[place] == level[place - 1]:
            way[place] = way[place - 1]
    turn = (np.diff(way) != 0.0) | (np.diff(level) != 0.0)
    edges = [0, *(np.flatnonzero(turn) + 1), frequency.size]
    return [
        (first, last)
        for first, last in itertools.pairwise(edges)
        if level[first] > 0.0 and way[first] != 0.0 and last - first >= FEWEST
    ]
