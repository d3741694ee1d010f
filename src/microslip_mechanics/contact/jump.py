"""By how much the force of a point jumps as its faces touch (theory §8)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge
from microslip_mechanics.contact.points import ContactPoints


def contact_jump(
    points: ContactPoints, point: int, velocity: Array, beside: float
) -> Array:
    """Return the force of a point just closed less that of one just open [N], (3,).

    The moment of a jump moves by −δw/ẇ with the normal motion w: over |ẇ| it changes
    the momentum like a stiffness that acts at that moment alone.

    Parameters
    ----------
    points, point
        The table and the row in it, of a contact that has an edge.
    velocity
        As it touches or parts [m/s]: normal and two tangents, shape ``(3,)``.
    beside
        How far from the edge both sides of it are looked at [m].
    """
    forces, tangents = np.zeros((2, 3)), np.zeros((2, 3, 3))
    for side, force in zip((-beside, beside), forces, strict=True):
        place = np.array([edge(points, point) + side, 0.0, 0.0])
        contact_force(points, point, place, velocity, force, *tangents)
    jump: Array = forces[1] - forces[0]
    return jump
