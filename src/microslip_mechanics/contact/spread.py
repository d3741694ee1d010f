"""Forces that jump as faces touch, as the steps of a march see them (theory §7.1)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge, sudden
from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from microslip_mechanics.jit import bare_kernel

BESIDE = 1e-9
"""of the way of a step: how far inside the edge the jump is looked at"""
EPSILON = float(np.finfo(float).eps)


@bare_kernel
def spread_force(
    points: ContactPoints,
    point: int,
    step: float,
    displacement: Array,
    velocity: Array,
    force: Array,
    tangents: Array,
) -> None:
    """Write the force of one contact point and its tangents, its jump spread.

    A step knows forces at its ends only. One that jumps in between acts for whole steps
    though it does so for parts of them: a march of such steps leaps with where in a
    step the faces touch. Hence the jump comes as a share that grows from 0 to 1 within
    a step before and after the edge: its mean over the straight motion with the weights
    1 − |τ|/h, with which its impulse and the moment of that are right.

    Parameters
    ----------
    points, point, displacement, velocity, force
        As of :func:`~microslip_mechanics.contact.law.contact_force`.
    step
        h [s]; without one the force jumps.
    tangents
        Written: by displacement and by velocity, then work, shape ``(5, 3, 3)``.
    """
    contact_force(
        points, point, displacement, velocity, force, tangents[0], tangents[1]
    )
    if points.normal[point] != ONE_SIDED or not sudden(points, point):
        return
    way = step * abs(velocity[0])
    inside = displacement[0] - edge(points, point)
    if abs(inside) >= way:
        return
    place, jump = tangents[2, 0], tangents[2, 1]
    beside = max(BESIDE * way, 4.0 * EPSILON * abs(points.gap[point]))
    place[0], place[1], place[2] = edge(points, point) + beside, 0.0, 0.0
    contact_force(points, point, place, velocity, jump, tangents[3], tangents[4])
    away = 1.0 - abs(inside) / way
    share = 0.5 * away**2 if inside <= 0.0 else -0.5 * away**2
    axes = 1 if points.constant_load[point] else 3
    for axis in range(axes):
        force[axis] += share * jump[axis]
        for other in range(3):
            tangents[1, axis, other] += share * tangents[4, axis, other]
        tangents[0, axis, 0] += away * jump[axis] / way
        tangents[1, axis, 0] -= away * jump[axis] * inside / (way * velocity[0])
