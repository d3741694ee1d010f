"""Pictures of the envelope of a march."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.march import TIME, Panels, march_figure
from microslip.figures.names import called, force_kind, listed, readable
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    legend_beside,
    widened,
)
from microslip_mechanics.results.envelope import Envelope


def envelope_figure(envelope: Envelope, title: str) -> Figure:
    """Draw ranges of each cycle over time, energies, and amplitude over frequency."""
    return march_figure(
        envelope,
        title,
        Panels(_displacement, _relative_velocity, _normal_force, _friction_power),
        motions=(envelope.lowest, envelope.highest),
        forces=envelope.normal_largest,
        rubs=bool(envelope.of("friction").any()),
    )


def _displacement(axes: Axes, envelope: Envelope, place: int, colour: str) -> None:
    """Draw the range of one probe."""
    low, high = envelope.lowest[:, place], envelope.highest[:, place]
    axes.fill_between(envelope.time, 1e3 * low, 1e3 * high, color=colour, linewidth=0)
    name = readable(envelope.probes[place])
    framed(axes, x=TIME, y="displacement [mm]", title=f"Displacement, {name}")


def _relative_velocity(axes: Axes, envelope: Envelope, place: int) -> None:
    """Draw the largest velocity of one relative motion."""
    axes.plot(envelope.time, envelope.fastest[:, place], color="0.25", linewidth=WIDTH)
    name = readable(envelope.probes[place])
    title = f"Largest relative velocity, {name}"
    framed(axes, x=TIME, y="velocity [m/s]", title=title)


def _normal_force(axes: Axes, envelope: Envelope, face: str, places: list[int]) -> None:
    """Draw the range of normal forces at the points of one face."""
    for colour, place in zip(COLOURS, places, strict=False):
        axes.fill_between(
            envelope.time,
            envelope.normal_smallest[:, place],
            envelope.normal_largest[:, place],
            alpha=0.4,
            color=colour,
            linewidth=WIDTH,
            label=listed(envelope.contacts[place]),
        )
    where = called(face, [envelope.contacts[place] for place in places])
    low, high = envelope.normal_smallest[:, places], envelope.normal_largest[:, places]
    framed(axes, x=TIME, y="force [N]", title=f"{force_kind(low, high)}, {where}")
    widened(axes)
    legend_beside(axes, high)


def _friction_power(axes: Axes, envelope: Envelope) -> None:
    """Draw the mean power that friction develops in each cycle, negative as in rows."""
    spent = np.diff(envelope.of("friction")) / np.diff(envelope.time)
    axes.plot(envelope.time[1:], -spent, color=COLOURS[1], linewidth=WIDTH)
    title = "Power developed by friction forces, mean of each cycle"
    framed(axes, x=TIME, y="power [W]", title=title)
