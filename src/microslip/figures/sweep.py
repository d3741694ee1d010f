"""Pictures of a time history, in the manner of the paper's Figures 4 to 9."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.names import (
    called,
    faces,
    force_kind,
    foremost,
    readable,
    relative,
)
from microslip.figures.passes import amplitude, passes
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    alike,
    framed,
    headline,
    legend_above,
    legend_beside,
    one_range,
)
from microslip_mechanics.arrays import Array
from microslip_mechanics.envelope import Envelope
from microslip_mechanics.time_history import TimeHistory

TIME = "time [s]"
BROAD = 3.0
"""width of the input's line beside others"""
ROUNDING = 1e-12
"""share of the largest energy below which another is nothing but rounding"""


def sweep_figure(history: TimeHistory, title: str) -> Figure:
    """Draw displacements, relative velocities, normal forces, friction and energies.

    What a scene does not have is left out. Where the cycles of a sweep can be seen,
    their amplitude against frequency follows.
    """
    slips = relative(history.probes)
    shrouds = pressed(faces(history.contacts), history.normal_force)
    sizes = abs(history.displacement).max(axis=0, initial=0.0)
    blades, ways = foremost(history.probes, sizes), passes(history)
    rubs = bool(history.friction_power.any())
    count = len(blades) + len(slips) + len(shrouds) + int(rubs) + 1
    figure, panels, others = grid_of(count, len(blades) if ways else 0)
    limits = one_range(1e3 * history.displacement[:, place] for place in blades)
    for colour, place in zip(COLOURS, blades, strict=False):
        axes = next(panels)
        displacement(axes, history, place, colour)
        axes.set_ylim(limits)
    for place in slips:
        relative_velocity(next(panels), history, place)
    for face, places in shrouds.items():
        normal_force(next(panels), history, face, places)
    if rubs:
        friction_power(next(panels), history)
    energies(next(panels), history)
    for axes, place in zip(others, blades, strict=False):
        amplitude(axes, ways, place, history.probes[place])
    headline(figure, title)
    return figure


def pressed(shrouds: dict[str, list[int]], forces: Array) -> dict[str, list[int]]:
    """Return the faces of which some point has a normal force; ``forces`` over time."""
    return {
        name: places
        for name, places in shrouds.items()
        if (forces[:, places] != 0.0).any()
    }


def grid_of(count: int, others: int) -> tuple[Figure, Iterator[Axes], list[Axes]]:
    """Return a figure with panels that share their time axis, and with some others."""
    lines = (count + others + 1) // 2
    figure = Figure(figsize=(10.0, 2.6 * lines), layout="constrained")
    axes = list(figure.subplots(lines, 2, squeeze=False).ravel())
    panels, last = axes[:count], axes[count : count + others]
    for panel in panels[1:]:
        panel.sharex(panels[0])
    for panel in axes:
        if panel not in (*panels, *last):
            panel.remove()
    return figure, iter(panels), last


def displacement(axes: Axes, history: TimeHistory, place: int, colour: str) -> None:
    """Draw the displacement of one probe."""
    shown = 1e3 * history.displacement[:, place]
    axes.plot(history.time, shown, color=colour, linewidth=0.2, rasterized=True)
    name = readable(history.probes[place])
    framed(axes, x=TIME, y="displacement [mm]", title=f"Displacement, {name}")


def relative_velocity(axes: Axes, history: TimeHistory, place: int) -> None:
    """Draw one relative velocity."""
    shown = history.velocity[:, place]
    axes.plot(history.time, shown, color="0.25", linewidth=0.2, rasterized=True)
    name = readable(history.probes[place])
    framed(axes, x=TIME, y="velocity [m/s]", title=f"Relative velocity, {name}")


def normal_force(
    axes: Axes, history: TimeHistory, face: str, places: list[int]
) -> None:
    """Draw the normal forces of the points of one face."""
    groups = alike(history.normal_force, places)
    for colour, group in zip(COLOURS, groups, strict=False):
        axes.plot(
            history.time,
            history.normal_force[:, group[0]],
            color=colour,
            linewidth=0.3,
            alpha=0.8,
            label=", ".join(history.contacts[place] for place in group),
            rasterized=True,
        )
    where = called(face, [history.contacts[place] for place in places])
    shown = history.normal_force[:, places]
    title = f"{force_kind(shown, shown)}, {where}"
    framed(axes, x=TIME, y="force [N]", title=title)
    legend_beside(axes, shown)
    legend = axes.get_legend()
    for line in legend.get_lines() if legend else ():
        line.set_linewidth(2.0)


def friction_power(axes: Axes, history: TimeHistory) -> None:
    """Draw the power that friction develops; it is negative, as in the paper."""
    shown = -history.friction_power
    axes.plot(history.time, shown, color=COLOURS[1], linewidth=0.3, rasterized=True)
    framed(axes, x=TIME, y="power [W]", title="Power developed by friction forces")


def energies(axes: Axes, history: TimeHistory | Envelope) -> None:
    """Draw the energies that flowed, and the closing error of their balance.

    The input is a broad line, on which another that is as large can be seen.
    """
    names = ("input", "friction", "normal_damping", "structural_damping")
    flows = {name: history.of(name) for name in names}
    least = ROUNDING * max(float(np.abs(flow).max()) for flow in flows.values())
    for colour, (name, flow) in zip(COLOURS, flows.items(), strict=False):
        if np.abs(flow).max() <= least:
            continue
        axes.plot(
            history.time,
            flow,
            color=colour,
            linewidth=WIDTH * (BROAD if name == "input" else 1.5),
            label=f"{name.replace('_', ' ')}: {flow[-1]:.4g} J",
        )
    closing = abs(history.closing_error).max()
    title = f"Energy since the start (closing error {closing:.1e} J)"
    framed(axes, x=TIME, y="energy [J]", title=title)
    legend_above(axes)
