"""What a march returns: probes, contact forces and energies over time."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Checkpoint:
    """The end of a block: from here a march goes on as if it had never stopped."""

    displacement: Array
    """[m], shape (dofs,)"""
    velocity: Array
    """[m/s], shape (dofs,)"""
    memory: Array
    """what else the integrator keeps, in an order of its own, shape (numbers,)"""


@dataclass(frozen=True, slots=True)
class TimeHistory:
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

    def of(self, energy: str) -> Array:
        """Return one energy over time [J], shape (times,)."""
        column: Array = self.energy[:, self.energies.index(energy)]
        return column

    @property
    def closing_error(self) -> Array:
        """What the energy balance leaves [J], shape (times,) (theory, eq. 26)."""
        others = [place for place, name in enumerate(self.energies) if name != "input"]
        spent: Array = self.energy[:, others].sum(axis=1)
        return self.of("input") + self.stored_at_start - spent


def joined(blocks: Sequence[TimeHistory], ending: str) -> TimeHistory:
    """Return blocks of one march as one history."""
    first = blocks[0]
    whole: dict[str, Any] = {
        field.name: np.concatenate([getattr(block, field.name) for block in blocks])
        for field in fields(first)
        if isinstance(getattr(first, field.name), np.ndarray)
    }
    return replace(
        first,
        **whole,
        iterations=sum(block.iterations for block in blocks),
        divided=sum(block.divided for block in blocks),
        ending=ending,
        checkpoint=blocks[-1].checkpoint,
    )
