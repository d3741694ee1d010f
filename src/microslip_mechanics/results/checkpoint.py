"""The end of a block of a march, from which it can go on."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.arrays import Array
from microslip_mechanics.by_value import ByValue


@dataclass(frozen=True, slots=True, eq=False)
class Checkpoint(ByValue):
    """The end of a block: from here a march goes on as if it had never stopped."""

    displacement: Array
    """[m], shape (dofs,)"""
    velocity: Array
    """[m/s], shape (dofs,)"""
    memory: Array
    """what else the integrator keeps, in an order of its own, shape (numbers,)"""
