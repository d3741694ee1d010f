"""Pictures of a time history, in the manner of the paper's Figures 4 to 9."""

from __future__ import annotations

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.march import TIME, Panels, march_figure
from microslip.figures.names import called, force_kind, listed, readable
from microslip.figures.style import (
    COLOURS,
    alike,
    framed,
    legend_beside,
    widened,
)
from microslip_mechanics.results.time_history import TimeHistory


def sweep_figure(history: TimeHistory, title: str) -> Figure:
    """Draw displacements, relative velocities, normal forces, friction and energies.

    What a scene does not have is left out. Where the cycles of a sweep can be seen,
    their amplitude against frequency follows.
    """
    return march_figure(
        history,
        title,
        Panels(displacement, relative_velocity, normal_force, friction_power),
        motions=(history.displacement,),
        forces=history.normal_force,
        rubs=bool(history.friction_power.any()),
    )


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
            label=listed(*(history.contacts[place] for place in group)),
            rasterized=True,
        )
    where = called(face, [history.contacts[place] for place in places])
    shown = history.normal_force[:, places]
    title = f"{force_kind(shown, shown)}, {where}"
    framed(axes, x=TIME, y="force [N]", title=title)
    widened(axes)
    legend_beside(axes, shown)
    legend = axes.get_legend()
    for line in legend.get_lines() if legend else ():
        line.set_linewidth(2.0)


def friction_power(axes: Axes, history: TimeHistory) -> None:
    """Draw the power that friction develops; it is negative, as in the paper."""
    shown = -history.friction_power
    axes.plot(history.time, shown, color=COLOURS[1], linewidth=0.3, rasterized=True)
    framed(axes, x=TIME, y="power [W]", title="Power developed by friction forces")
