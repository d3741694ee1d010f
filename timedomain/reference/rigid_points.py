"""The contact points of a problem that are rigid."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import RIGID
from microslip_mechanics.problem import Problem


class Sliders(NamedTuple):
    """The rigid points of a problem, each with both tangents."""

    points: NDArray[np.int64]
    """shape (count,)"""
    rows: Array
    """sliding displacements from y, shape (2 count, rank)"""
    normals: Array
    """penetrations from y, shape (count, rank)"""
    release: Array
    """acceleration from forces on y, M⁻¹ Lᵀ, shape (dofs, rank)"""


def sliders(problem: Problem) -> Sliders:
    """Return the rigid points of a problem."""
    basis, selection = problem.interface.relative_motion()
    points = np.flatnonzero(problem.interface.points.friction == RIGID)
    tangents = (3 * points[:, None] + np.array([1, 2])).ravel()
    mass = problem.structure.dense.mass
    return Sliders(
        points,
        np.ascontiguousarray(basis[tangents]),
        np.ascontiguousarray(basis[3 * points]),
        np.linalg.solve(mass, selection.T),
    )
