"""Friction that depends on where the contact was before: one call for all such laws."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.bristle import Bristles, bristle_traction
from microslip_mechanics.contact.elastic import ElasticFriction, elastic_traction
from microslip_mechanics.contact.law import (
    BRISTLE,
    ELASTIC,
    ContactPoints,
    normal_response,
)
from microslip_mechanics.jit import kernel

MEMORIES = (ELASTIC, BRISTLE)
"""kinds of friction that remember"""


def remembers(points: ContactPoints) -> NDArray[np.bool_]:
    """Return which points have friction that depends on where they were, (points,)."""
    return np.isin(points.friction, MEMORIES)


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
        Increment of the sliding displacement [m], and velocity [m/s] at its end, each
        of shape ``(2,)``.
    load
        Normal load [N] at its end.
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
