"""What a march returns: probes, contact forces and energies over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, fields, replace
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.by_value import ByValue

if TYPE_CHECKING:
    from microslip_mechanics.results.envelope import Envelope

Block = TypeVar("Block", "TimeHistory", "Envelope")


@dataclass(frozen=True, slots=True, eq=False)
class Checkpoint(ByValue):
    """The end of a block: from here a march goes on as if it had never stopped."""

    displacement: Array
    """[m], shape (dofs,)"""
    velocity: Array
    """[m/s], shape (dofs,)"""
    memory: Array
    """what else the integrator keeps, in an order of its own, shape (numbers,)"""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class TimeHistory(ByValue):
    """Response to a load history at stored times."""

    time: Array
    """[s], shape (times,)"""
    probes: tuple[str, ...]
    displacement: Array
    """of each probe [m], shape (times, probes)"""
    velocity: Array
    """of each probe [m/s], shape (times, probes)"""
    contacts: tuple[str, ...]
    normal_force: Array
    """of each contact point [N], shape (times, contacts)"""
    friction_power: Array
    """taken out by friction [W], shape (times,)"""
    energies: tuple[str, ...]
    energy: Array
    """[J], shape (times, energies): what flowed so far and what is stored"""
    stored_at_start: float
    """energy stored when the march began [J]"""
    time_step: float
    """[s]"""
    iterations: int
    """Newton iterations of all steps"""
    divided: int
    """steps that converged only when they were divided"""
    ending: str = "complete"
    """how the march ended: "complete", "interrupted", or the cause"""
    checkpoint: Checkpoint | None = None
    """at the last time, if the march can go on from there"""

    frequency: Array = field(default_factory=lambda: np.zeros(0))
    """of the drive [rad/s], shape (times,), or empty if not told"""
    level: Array = field(default_factory=lambda: np.zeros(0))
    """amplitude of the drive's sine over the problem's, like ``frequency``"""
    energy_error: Array = field(default_factory=lambda: np.zeros(0))
    """estimated, of the energy taken out by friction so far [J], shape (times,), or
    empty if not estimated"""
    peak_error: Array = field(default_factory=lambda: np.zeros(0))
    """estimated, of the largest amplitude so far, relative, like ``energy_error``"""
    work_difference: Array = field(default_factory=lambda: np.zeros(0))
    """friction's energy less that by another of two ways, mean force times sliding
    increment and times the mean of both ends' velocities [J], like ``energy_error``"""

    def __repr__(self) -> str:
        """Return what kind of history it is, in a line."""
        until = f" until {self.time[-1]:g} s" if self.time.size else ""
        return (
            f"<TimeHistory: {self.time.size} times{until}; "
            f"probes {', '.join(self.probes)}; {self.ending}>"
        )

    def of(self, energy: str) -> Array:
        """Return one energy over time [J], shape (times,)."""
        return energy_of(self, energy)

    @property
    def closing_error(self) -> Array:
        """What the energy balance leaves [J], shape (times,) (theory, eq. 26)."""
        return closing_error(self)


def energy_of(result: TimeHistory | Envelope, name: str) -> Array:
    """Return one energy [J], shape (rows,)."""
    column: Array = result.energy[:, result.energies.index(name)]
    return column


def closing_error(result: TimeHistory | Envelope) -> Array:
    """Return what the energy balance leaves [J], shape (rows,) (theory, eq. 26)."""
    others = [place for place, name in enumerate(result.energies) if name != "input"]
    spent: Array = result.energy[:, others].sum(axis=1)
    return energy_of(result, "input") + result.stored_at_start - spent


def joined(blocks: Sequence[Block], ending: str) -> Block:
    """Return blocks of one march as one."""
    first = blocks[0]
    whole: dict[str, Any] = {
        each.name: np.concatenate([getattr(block, each.name) for block in blocks])
        for each in fields(first)
        if isinstance(getattr(first, each.name), np.ndarray)
    }
    return replace(
        first,
        **whole,
        iterations=sum(block.iterations for block in blocks),
        divided=sum(block.divided for block in blocks),
        ending=ending,
        checkpoint=blocks[-1].checkpoint,
    )
