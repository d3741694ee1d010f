"""Exact dynamic condensation onto the relative motion of the contacts (theory §6.1)."""

from __future__ import annotations

import numpy as np

from hbm.structure.condensed_structure import CondensedStructure
from hbm.structure.stuck_motions import stuck_motions
from hbm.structure.stuck_poles import stuck_poles
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem


def condense(problem: Problem, selection: Array) -> CondensedStructure:
    """Return the structure condensed onto ``selection`` (shape (rank, dofs)).

    Raises
    ------
    ValueError
        If the structure is sparse, is driven away or moves freely against damping
        while all contacts stick, or if damping makes two of its poles coincide.
    """
    structure = problem.structure.dense
    static, free, unheld = stuck_motions(structure, selection)
    poles, shapes, forcing = stuck_poles(
        *(free.T @ matrix @ free
          for matrix in (structure.mass, structure.damping, structure.stiffness))
    )  # fmt: skip
    viscous = free.T @ structure.damping @ static
    inertial = free.T @ structure.mass @ static
    return CondensedStructure(
        static.T @ structure.stiffness @ static,
        static.T @ structure.damping @ static,
        static.T @ structure.mass @ static,
        poles,
        forcing @ viscous,
        forcing @ inertial,
        static.T @ structure.damping @ free @ shapes,
        inertial.T @ shapes,
        static,
        free @ shapes,
        forcing @ free.T,
        unheld,
        np.arange(poles.size),
        structure.gyroscopic,
    )
