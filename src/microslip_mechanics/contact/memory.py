"""Friction that depends on where the contact was before: one call for all such laws."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.bristle import Bristles, bristle_traction
from microslip_mechanics.contact.elastic import ElasticFriction, elastic_traction
from microslip_mechanics.contact.normal import normal_response
from microslip_mechanics.contact.points import BRISTLE, ELASTIC, RIGID, ContactPoints
from microslip_mechanics.jit import bare_kernel, inner_kernel, kernel

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


@bare_kernel
def traction_energy(points: ContactPoints, point: int, traction: Array) -> float:
    """Return what the spring k_t of one point stores [J], 0 if it has no memory.

    ``traction`` is what it remembers [N], shape ``(2,)``.
    """
    kind = points.friction[point]
    if kind not in (ELASTIC, BRISTLE):
        return 0.0
    squared = traction[0] ** 2 + traction[1] ** 2
    return float(0.5 * squared / points.tangential[point])


class Press(NamedTuple):
    """How a point is pressed at one end of a slide."""

    load: float
    """of friction [N]; zero out of contact"""
    depth: float
    """by which its faces overlap [m]; infinite under a constant load"""


@bare_kernel
def traction(
    points: ContactPoints,
    point: int,
    slide: Array,
    velocity: Array,
    press: Press,
    past: Press,
    old: Array,
    new: Array,
    by: Array,
) -> None:
    """Write the traction of one point after a small slide, and its derivatives.

    A point that touches within the slide slides from there on. The error of a motion
    that is cut into slides falls with the square of their length.

    Parameters
    ----------
    points, point
        The table and the row in it.
    slide, velocity
        Increment of the sliding displacement [m], and the mean of the velocities at
        both ends [m/s], each of shape ``(2,)``.
    press, past
        At the end and at the beginning.
    old, new
        Traction before, and written: after it [N], each of shape ``(2,)``.
    by
        Written: derivatives of both components by slide (2), velocity (2), load (1),
        load before (1), old traction (2), depth (1) and depth before (1), shape
        ``(2, 10)``.
    """
    touching, touches = 1.0, past.depth < 0.0 < press.depth
    if touches:
        touching = press.depth / (press.depth - past.depth)
    slid = touching * slide[0], touching * slide[1]
    _slid(points, point, slid, velocity, press.load, past.load, old, new, by)
    if not touches:
        return
    for row in range(2):
        longer = by[row, 0] * slide[0] + by[row, 1] * slide[1]
        longer /= press.depth - past.depth
        by[row, 0], by[row, 1] = touching * by[row, 0], touching * by[row, 1]
        by[row, 8], by[row, 9] = longer * (1.0 - touching), longer * touching


@inner_kernel
def _slid(
    points: ContactPoints,
    point: int,
    slide: tuple[float, float],
    velocity: Array,
    load: float,
    past_load: float,
    old: Array,
    new: Array,
    by: Array,
) -> None:
    """Write the traction as the law has it, after a slide that is in contact."""
    if points.friction[point] == ELASTIC:
        elastic = ElasticFriction(points.tangential[point], points.dynamic[point])
        elastic_traction(elastic, slide, load, past_load, old, new, by)
        return
    bristles = Bristles(
        points.tangential[point],
        points.dynamic[point],
        points.static[point],
        points.stribeck[point],
        points.stribeck_exponent[point],
    )
    bristle_traction(bristles, slide, velocity, load, past_load, old, new, by)


@bare_kernel
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


@bare_kernel
def pressed(
    points: ContactPoints, point: int, displacement: float, velocity: float
) -> tuple[Press, float, float]:
    """Return how a point is pressed, and the derivatives of its load.

    They are those by ``displacement`` and ``velocity`` along the normal; zero out of
    contact.
    """
    load, by_depth, by_approach = friction_load(points, point, displacement, velocity)
    depth = displacement - points.gap[point]
    if points.constant_load[point]:
        depth = math.inf
    if load <= 0.0:
        return Press(0.0, depth), 0.0, 0.0
    return Press(load, depth), by_depth, by_approach


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
        [m/s], and its normal load [N] and depth [m], shape ``(4, 2)``.
    fresh
        Written: the same for now.
    force, by_displacement, by_velocity
        As :func:`~microslip_mechanics.contact.law.contact_force` wrote them; added to.
    """
    slide, speed, by = np.empty(2), np.empty(2), np.empty((2, 10))
    press, by_depth, by_approach = pressed(points, point, displacement[0], velocity[0])
    before = Press(past[3, 0], past[3, 1])
    fresh[3, 0], fresh[3, 1] = press.load, press.depth
    for axis in range(2):
        fresh[0, axis] = displacement[axis + 1]
        fresh[2, axis] = velocity[axis + 1]
        slide[axis] = displacement[axis + 1] - past[0, axis]
        speed[axis] = 0.5 * (fresh[2, axis] + past[2, axis])
    traction(points, point, slide, speed, press, before, past[1], fresh[1], by)
    for row in range(2):
        force[row + 1] += fresh[1, row]
        by_displacement[row + 1, 0] += by[row, 4] * by_depth + by[row, 8]
        by_velocity[row + 1, 0] += by[row, 4] * by_approach
        for column in range(2):
            by_displacement[row + 1, column + 1] += by[row, column]
            by_velocity[row + 1, column + 1] += 0.5 * by[row, column + 2]
