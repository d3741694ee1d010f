"""Picture of a dwell: how it settles, and the period in which it ends."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from microslip.figures.amplitude import greatest
from microslip.figures.fitted import fitted
from microslip.figures.march import energies
from microslip.figures.names import (
    absolute,
    foremost,
    listed_motion,
    relative,
    swings,
)
from microslip.figures.style import COLOURS, STYLES, WIDTH, framed, headline
from microslip.figures.sweep import displacement
from microslip_mechanics.results.time_history import TimeHistory

FEW = 40
"""distances up to which each is a dot: a line through one alone would not be seen"""


def dwell_figure(
    history: TimeHistory, distances: Sequence[float], tolerance: float, title: str
) -> Figure:
    """Draw displacements, the last period, the distance from steady, and energies.

    Parameters
    ----------
    history
        All periods, each with as many rows.
    distances
        From the steady state, of each period; inf while unknown.
    tolerance
        Of the distance.
    title
        Of the figure.
    """
    figure = Figure(figsize=(10.0, 7.8), layout="constrained")
    panels = figure.subplots(3, 2)
    sizes = swings([history.displacement])
    shown = greatest(foremost(history.probes, sizes), sizes[None], len(panels[0]))
    for axes, colour, place in zip(panels[0], COLOURS, shown, strict=False):
        displacement(axes, history, place, colour)
    for axes in panels[0][len(shown) :]:
        axes.remove()
    rows = len(history.time) // max(1, len(distances))
    _orbit(panels[1, 0], history, rows)
    _velocities(panels[1, 1], history, rows)
    _distance(panels[2, 0], distances, tolerance)
    energies(panels[2, 1], history)
    fitted(figure)
    headline(figure, title)
    return figure


def _orbit(axes: Axes, history: TimeHistory, rows: int) -> None:
    moved = abs(history.displacement[-rows:])
    shown = greatest(absolute(history.probes), moved, len(STYLES))
    lines = zip(COLOURS, STYLES, shown, strict=False)
    for colour, style, place in lines:
        axes.plot(
            _since(history, rows),
            1e3 * history.displacement[-rows:, place],
            style,
            color=colour,
            linewidth=WIDTH * 1.5,
            label=listed_motion(history.probes[place]),
        )
    framed(axes, x="time [ms]", y="displacement [mm]", title="The last period")
    axes.legend(frameon=False, fontsize="small")


def _velocities(axes: Axes, history: TimeHistory, rows: int) -> None:
    """Draw relative velocities or, where no probe is one, those of all."""
    slips = relative(history.probes)
    fast = abs(history.velocity[-rows:])
    places = greatest(slips or absolute(history.probes), fast, len(STYLES))
    for colour, style, place in zip(COLOURS, STYLES, places, strict=False):
        axes.plot(
            _since(history, rows),
            history.velocity[-rows:, place],
            style,
            color=colour,
            linewidth=WIDTH * 1.5,
            label=listed_motion(history.probes[place]),
        )
    name = "Relative velocities" if slips else "Velocities"
    framed(axes, x="time [ms]", y="velocity [m/s]", title=f"{name} in the last period")
    axes.legend(frameon=False, fontsize="small")


def _distance(axes: Axes, distances: Sequence[float], tolerance: float) -> None:
    values = np.array(distances)
    known = np.isfinite(values) & (values > 0.0)
    shown = np.flatnonzero(known) + 1
    style = ".-" if len(shown) <= FEW else "-"
    axes.plot(
        shown, values[known], style, color=COLOURS[0], lw=WIDTH, ms=5.0, clip_on=False
    )
    axes.axhline(tolerance, color="0.15", linewidth=WIDTH, linestyle="--")
    axes.set_yscale("log")
    axes.set_xlim(0.0, max(1, len(distances)))
    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, integer=True))
    if not known.any():
        axes.text(
            0.5, 0.5, "not known after so few periods", ha="center", color="0.3",
            transform=axes.transAxes,
        )  # fmt: skip
    title = "Distance from the steady state (dashed: tolerance)"
    framed(axes, x="period [-]", y="relative distance [-]", title=title)


def _since(history: TimeHistory, rows: int) -> np.ndarray:
    """Return the time within the last period [ms]."""
    time = 1e3 * history.time[-rows:]
    begin = 1e3 * history.time[-rows - 1] if rows < len(history.time) else 0.0
    return time - begin
