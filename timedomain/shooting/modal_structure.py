"""A structure in its undamped modes, and what its contacts see of them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.undamped_modes import undamped_modes


@dataclass(frozen=True, slots=True)
class ModalStructure:
    """A structure in its undamped modes, and what its contacts see of them."""

    shapes: Array
    """Φ, mass-normalised, shape (dofs, modes)"""
    inverse: Array
    """Φ⁻¹ = Φᵀ M, shape (modes, dofs)"""
    stiffness: Array
    """Ω² [1/s²], shape (modes,)"""
    damping: Array
    """Φᵀ C Φ [1/s], shape (modes, modes)"""
    selection: Array
    """relative coordinates from the modes, shape (rank, modes)"""

    @classmethod
    def of(cls, problem: Problem) -> ModalStructure:
        """Return the modes of a problem's structure, which is not sparse."""
        structure = problem.structure.dense
        _, selection = problem.interface.relative_motion()
        stiffness, shapes = undamped_modes(structure.stiffness, structure.mass)
        return cls(
            shapes,
            shapes.T @ structure.mass,
            stiffness,
            shapes.T @ structure.damping @ shapes,
            np.ascontiguousarray(selection @ shapes),
        )
