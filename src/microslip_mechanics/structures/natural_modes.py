"""The slowest undamped modes of a structure without its contacts."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.structure import Structure
from microslip_mechanics.structures.stuck import stuck_structure
from microslip_mechanics.structures.stuck_modes import slowest


@dataclass(frozen=True, slots=True)
class NaturalModes:
    """Frequencies and shapes, the slowest first."""

    frequencies: Array
    """[rad/s], shape (modes,)"""
    shapes: Array
    """of unit mass, shape (dofs, modes)"""


def natural_modes(structure: Structure, count: int) -> NaturalModes:
    """Return the slowest modes.

    Raises
    ------
    ValueError
        If there are not so many, or if a sparse structure can move freely.
    """
    if count > structure.dofs:
        raise ValueError(
            f"{count} modes of a structure with {structure.dofs} degrees of freedom: "
            f"give {structure.dofs} at the most"
        )
    if structure.sparse:
        held = stuck_structure(structure, np.zeros((0, structure.dofs)))
        squares, shapes = slowest(held, count)
        squares, shapes = squares[:count], shapes[:, :count]
    else:
        squares, shapes = scipy.linalg.eigh(
            structure.stiffness, structure.mass, subset_by_index=(0, count - 1)
        )
    return NaturalModes(np.sqrt(np.maximum(squares, 0.0)), shapes)
