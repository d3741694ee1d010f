"""Friction that depends on where the contact was before: one call for all such laws."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.bristle import Bristles, bristle_traction
from microslip_mechanics.contact.elastic import ElasticFriction, elastic_traction
from microslip_mechanics.contact.law import normal_response
from microslip_mechanics.contact.points import BRISTLE, ELASTIC, RIGID, ContactPoints
from microslip_mechanics.jit import kernel

MEMORIES = (ELASTIC, BRISTLE)
"""kinds of friction that remember"""


def remembers(points: ContactPoints) -> NDArray[np.bool_]:
    """Return which points have friction that depends on where they were, (points,)."""
    return np.isin(points.friction, MEMORIES)


def beyond_motion(points: ContactPoints) -> bool:
    """Return whether some friction is no function of the motion at one moment.

    Such a point remembers, or it is rigid: what it carries while it sticks follows from
    what the structure asks of it.
    """
    return bool((remembers(points) | (points.friction == RIGID)).any())


@kernel
def traction(
    points: ContactPoints,
    point: int,
    slide: Array,
    velocity: Array,
    load: float,
    old: Array,
    new: Array,
    by: Array,
) -> None:
    """Write the traction of one point after a small slide, and its derivatives.

    Parameters
    ----------
    points, point
        The table and the row in it.
    slide, velocity
        Increment of the sliding displacement [m], and velocity [m/s], each of shape
        ``(2,)``.
    load
        Normal load [N]. Bristles take the means of both ends, see :func:`end_share`.
    old, new
        Traction before, and written: after it [N], each of shape ``(2,)``.
    by
        Written: derivatives of both components by slide (2), velocity (2), load (1) and
        old traction (2), shape ``(2, 7)``.
    """
    if points.friction[point] == ELASTIC:
        elastic = ElasticFriction(points.tangential[point], points.dynamic[point])
        elastic_traction(elastic, slide, load, old, new, by)
        return
    bristles = Bristles(
        points.tangential[point],
        points.dynamic[point],
        points.static[point],
        points.stribeck[point],
        points.stribeck_exponent[point],
    )
    bristle_traction(bristles, slide, velocity, load, old, new, by)


@kernel
def end_share(points: ContactPoints, point: int) -> float:
    """Return the share that the end of a small slide has in velocity and load.

    Bristles slip all along it: means make the error fall with the square of the slide.
    A slider slips in the end.
    """
    return 0.5 if points.friction[point] == BRISTLE else 1.0


@kernel
def friction_load(
    points: ContactPoints, point: int, displacement: float, velocity: float
) -> tuple[float, float, float]:
    """Return the normal load of friction and its derivatives.

    ``displacement`` and ``velocity`` are those along the normal; the load is zero or
    less out of contact.
    """
    if points.constant_load[point]:
        return points.load[point], 0.0, 0.0
    return normal_response(points, point, displacement, velocity)


@kernel
def add_traction(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    past: Array,
    fresh: Array,
    force: Array,
    by_displacement: Array,
    by_velocity: Array,
) -> None:
    """Add what a point remembers to the force and tangents of its other laws.

    Parameters
    ----------
    points, point
        The table and the row in it.
    displacement, velocity
        Relative displacement [m] and velocity [m/s], each of shape ``(3,)``.
    past
        Where it was along both tangents [m], its traction there [N], its velocity
        [m/s], and its normal load [N] with a zero, shape ``(4, 2)``.
    fresh
        Written: the same for now.
    force, by_displacement, by_velocity
        As :func:`~microslip_mechanics.contact.law.contact_force` wrote them; added to.
    """
    slide, speed, by = np.empty(2), np.empty(2), np.empty((2, 7))
    share = end_share(points, point)
    load, by_depth, by_approach = friction_load(
        points, point, displacement[0], velocity[0]
    )
    fresh[3, 0] = load
    for axis in range(2):
        fresh[0, axis] = displacement[axis + 1]
        fresh[2, axis] = velocity[axis + 1]
        slide[axis] = displacement[axis + 1] - past[0, axis]
        speed[axis] = share * fresh[2, axis] + (1.0 - share) * past[2, axis]
    if load > 0.0:
        load = share * load + (1.0 - share) * max(past[3, 0], 0.0)
    traction(points, point, slide, speed, load, past[1], fresh[1], by)
    for row in range(2):
        force[row + 1] += fresh[1, row]
        by_displacement[row + 1, 0] += share * by[row, 4] * by_depth
        by_velocity[row + 1, 0] += share * by[row, 4] * by_approach
        for column in range(2):
            by_displacement[row + 1, column + 1] += by[row, column]
            by_velocity[row + 1, column + 1] += share * by[row, column + 2]
