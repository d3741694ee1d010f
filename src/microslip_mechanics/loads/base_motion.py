"""Ground that moves, and what it carries along."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array, numbers_of
from microslip_mechanics.structures.structure import Structure


@dataclass(frozen=True, slots=True)
class BaseMotion:
    """Ground that moves all supports alike; motions are then relative to it.

    ``direction`` is x, y, z, of any length, ``acceleration`` the amplitude along it
    [m/s²].
    """

    direction: Sequence[float]
    """x, y, z, of any length; degrees of freedom say theirs by names such as ``12.z``
    or ``tip.uz``"""
    acceleration: float
    """amplitude along it [m/s²]"""

    def __post_init__(self) -> None:
        """Check that there is a direction."""
        direction = numbers_of(self.direction)
        if direction.shape != (3,) or not direction.any():
            raise ValueError(
                f"base: direction {self.direction}: give three numbers, not all zero"
            )
        if numbers_of(self.acceleration).shape != ():
            raise ValueError(
                f"base: acceleration {self.acceleration}: give a finite number [m/s²]"
            )

    @property
    def unit(self) -> Array:
        """The direction, of length one."""
        direction = np.asarray(self.direction, dtype=float)
        unit: Array = direction / np.linalg.norm(direction)
        return unit

    def load(self, structure: Structure) -> Array:
        """Return the load on a structure [N], shape (dofs,)."""
        from microslip_mechanics.loads.base_excitation import (
            carried_inertia,
            translation,
        )

        carried = translation(structure.names, self.unit)
        return self.load_of(carried_inertia(structure, carried))

    def load_of(self, inertia: Array) -> Array:
        """Return the load of what the ground carries, given as M r [kg].

        Raises
        ------
        ValueError
            If it carries nothing.
        """
        if not inertia.any():
            told = ", ".join(f"{each:g}" for each in self.direction)
            raise ValueError(
                f"base: nothing of the structure moves along [{told}]: give a "
                "direction in which it does"
            )
        return -float(self.acceleration) * inertia
