"""Rigid bodies: small motion of their points, mass about a node (theory §2)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array


def point_motion(offset: Array) -> Array:
    """Return the map from a node's motion to the displacement of a rigid point.

    Parameters
    ----------
    offset
        Point minus node [m], shape ``(3,)``.

    Returns
    -------
    Shape ``(3, 6)``: displacement = u + θ × offset (theory, eq. 4).
    """
    x, y, z = offset
    turn = np.array([[0.0, z, -y], [-z, 0.0, x], [y, -x, 0.0]])
    return np.hstack([np.eye(3), turn])


def rigid_mass(mass: float, inertia: Array, offset: Array) -> Array:
    """Return the mass matrix of a rigid body about a node.

    Parameters
    ----------
    mass
        Mass [kg].
    inertia
        Inertia tensor about the centre of mass, global axes [kg m²], shape ``(3, 3)``.
    offset
        Centre of mass minus node [m], shape ``(3,)``.

    Returns
    -------
    Shape ``(6, 6)`` (theory, eq. 5).
    """
    motion = point_motion(offset)
    matrix = mass * motion.T @ motion
    matrix[3:, 3:] += inertia
    return matrix
