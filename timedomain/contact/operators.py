"""The matrices of average acceleration for one length of a step (theory, §7.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem


class Operators(NamedTuple):
    """Constant matrices of one step size (theory, eqs. 22–24)."""

    step: float
    """h [s]"""
    free: Array
    """free acceleration from the predicted (u, v), shape (dofs, 2 dofs)"""
    load: Array
    """free acceleration from the load factors, shape (dofs, loads)"""
    contact: Array
    """acceleration from contact forces, shape (dofs, rank)"""
    compliance: Array
    """relative acceleration from contact forces, shape (rank, rank)"""
    selection: Array
    """relative coordinates y from u, shape (rank, dofs)"""
    basis: Array
    """relative displacements of the points from y, shape (3 points, rank)"""


def step_operators(problem: Problem, shapes: Array, step: float) -> Operators:
    """Return the matrices of average acceleration (theory, eqs. 22–23)."""
    structure = problem.structure.dense
    basis, selection = problem.interface.relative_motion()
    half = 0.5 * step
    effective = (
        structure.mass + half * structure.damping + half**2 * structure.stiffness
    )
    inverse = np.linalg.inv(effective)
    contact = inverse @ selection.T
    return Operators(
        step,
        -inverse @ np.hstack([structure.stiffness, structure.damping]),
        inverse @ shapes,
        contact,
        selection @ contact,
        selection,
        basis,
    )
