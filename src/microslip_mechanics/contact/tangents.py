"""Tangents of all contact points at once, without what they remember (theory §4)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.spread import spread_force
from microslip_mechanics.jit import kernel


def contact_tangents(
    points: ContactPoints,
    basis: Array,
    displacement: Array,
    velocity: Array,
    step: float = 0.0,
) -> tuple[Array, Array]:
    """Return contact stiffness and damping on the relative coordinates.

    Parameters
    ----------
    points
        The contact table.
    basis
        Relative displacements of the points from the coordinates, (3 points, rank).
    displacement, velocity
        Of the points, relative, each of shape ``(times, points, 3)``.
    step
        Of a march [s], over which forces that jump are spread; 0 without one.

    Returns
    -------
    stiffness, damping
        ∂φ/∂y [N/m] and ∂φ/∂ẏ [N s/m], each of shape ``(times, rank, rank)``.
    """
    stiffness, damping = np.zeros((2, len(displacement), *2 * basis.shape[1:]))
    _tangents(points, basis, displacement, velocity, step, stiffness, damping)
    return stiffness, damping


@kernel
def _tangents(
    points: ContactPoints,
    basis: Array,
    displacement: Array,
    velocity: Array,
    step: float,
    stiffness: Array,
    damping: Array,
) -> None:
    force, tangents = np.zeros(3), np.zeros((5, 3, 3))
    stiff, viscous = tangents[0], tangents[1]
    moved, moving, rank = np.zeros(3), np.zeros(3), basis.shape[1]
    for phase in range(displacement.shape[0]):
        for point in range(displacement.shape[1]):
            for axis in range(3):
                moved[axis] = displacement[phase, point, axis]
                moving[axis] = velocity[phase, point, axis]
            spread_force(points, point, step, moved, moving, force, tangents)
            for entry in range(9):
                one, two = 3 * point + entry // 3, 3 * point + entry % 3
                for i in range(rank):
                    by = basis[one, i]
                    for j in range(rank):
                        seen = by * basis[two, j]
                        stiffness[phase, i, j] += stiff[entry // 3, entry % 3] * seen
                        damping[phase, i, j] += viscous[entry // 3, entry % 3] * seen
