"""Tangents of all contact points at once, without what they remember (theory §4)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel


def contact_tangents(
    points: ContactPoints, basis: Array, displacement: Array, velocity: Array
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

    Returns
    -------
    stiffness, damping
        ∂φ/∂y [N/m] and ∂φ/∂ẏ [N s/m], each of shape ``(times, rank, rank)``.
    """
    stiffness, damping = np.zeros((2, len(displacement), *2 * basis.shape[1:]))
    _tangents(points, basis, displacement, velocity, stiffness, damping)
    return stiffness, damping


@kernel
def _tangents(
    points: ContactPoints,
    basis: Array,
    displacement: Array,
    velocity: Array,
    stiffness: Array,
    damping: Array,
) -> None:
    force, stiff, viscous = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    for phase in range(displacement.shape[0]):
        for point in range(displacement.shape[1]):
            contact_force(
                points,
                point,
                displacement[phase, point],
                velocity[phase, point],
                force,
                stiff,
                viscous,
            )
            rows = basis[3 * point : 3 * point + 3]
            stiffness[phase] += np.dot(rows.T, np.dot(stiff, rows))
            damping[phase] += np.dot(rows.T, np.dot(viscous, rows))
