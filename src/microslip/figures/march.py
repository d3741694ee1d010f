"""Pictures of a march: displacements, velocities, forces, power and energies."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from microslip.figures.fitted import fitted
from microslip.figures.names import faces, foremost, relative, swings
from microslip.figures.passes import amplitude, passes
from microslip.figures.style import (
    COLOURS,
    WIDTH,
    framed,
    headline,
    legend_above,
    one_range,
)
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.energies import worded
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory

TIME = "time [s]"
BROAD = 3.0
"""width of the input's line beside others"""
ROUNDING = 1e-12
"""share of the largest energy below which another is nothing but rounding"""
March = TypeVar("March", TimeHistory, Envelope)


@dataclass(frozen=True, slots=True)
class Panels(Generic[March]):
    """How each kind of panel of a march is drawn."""

    displacement: Callable[[Axes, March, int, str], None]
    """of a probe, in a colour"""
    velocity: Callable[[Axes, March, int], None]
    """of a relative motion"""
    force: Callable[[Axes, March, str, list[int]], None]
    """at the points of a face"""
    power: Callable[[Axes, March], None]
    """of friction"""


def march_figure(
    march: March,
    title: str,
    panels: Panels[March],
    *,
    motions: Sequence[Array],
    forces: Array,
    rubs: bool,
) -> Figure:
    """Draw the panels of a march, its energies, and amplitude against frequency.

    What a scene does not have is left out, and so is the amplitude where the cycles of
    a sweep cannot be seen.

    Parameters
    ----------
    march, title
        What is drawn, and what it is called.
    panels
        How it is drawn.
    motions
        Displacements of the probes [m] that the picture holds, (rows, probes) each.
    forces
        Normal forces [N], shape (rows, contacts).
    rubs
        Whether friction does any work.
    """
    slips = relative(march.probes)
    shrouds = _pressed(faces(march.contacts), forces)
    blades, ways = foremost(march.probes, swings(motions)), passes(march)
    count = len(blades) + len(slips) + len(shrouds) + int(rubs) + 1
    figure, free, others = _grid(count, len(blades) if ways else 0)
    limits = one_range(1e3 * each[:, place] for each in motions for place in blades)
    for colour, place in zip(COLOURS, blades, strict=False):
        axes = next(free)
        panels.displacement(axes, march, place, colour)
        axes.set_ylim(limits)
    for place in slips:
        panels.velocity(next(free), march, place)
    for face, places in shrouds.items():
        panels.force(next(free), march, face, places)
    if rubs:
        panels.power(next(free), march)
    energies(next(free), march)
    for axes, place in zip(others, blades, strict=False):
        amplitude(axes, ways, place, march.probes[place])
    fitted(figure)
    headline(figure, title)
    return figure


def _pressed(shrouds: dict[str, list[int]], forces: Array) -> dict[str, list[int]]:
    """Return the faces of which some point has a normal force; ``forces`` over time."""
    return {
        name: places
        for name, places in shrouds.items()
        if (forces[:, places] != 0.0).any()
    }


def _grid(count: int, others: int) -> tuple[Figure, Iterator[Axes], list[Axes]]:
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


def energies(axes: Axes, march: TimeHistory | Envelope) -> None:
    """Draw the energies that flowed, and the closing error of their balance.

    The input is a broad line, on which another that is as large can be seen.
    """
    names = ("input", "friction", "normal_damping", "structural_damping")
    flows, pulls = {name: march.of(name) for name in names}, march.pulls
    least = ROUNDING * max(float(np.abs(flow).max()) for flow in flows.values())
    for colour, (name, flow) in zip(COLOURS, flows.items(), strict=False):
        if np.abs(flow).max() <= least:
            continue
        axes.plot(
            march.time,
            flow,
            color=colour,
            linewidth=WIDTH * (BROAD if name == "input" else 1.5),
            label=f"{worded(name, pulls=pulls)}: {flow[-1]:.4g} J",
        )
    closing = abs(march.closing_error).max()
    title = f"Energy since the start (closing error {closing:.1e} J)"
    framed(axes, x=TIME, y="energy [J]", title=title)
    legend_above(axes)
