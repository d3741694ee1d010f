"""Edges at which damping begins steeply: nodes are graded towards them (§6.1)."""

from __future__ import annotations

import math

from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from microslip_mechanics.jit import bare_kernel

STEEPEST = 4
"""order of the root, at the most, by which nodes are graded towards a steep edge"""
BESIDE = 2.0
"""cells beside a steep edge that are graded; the half that is farther away fades out"""


@bare_kernel
def steepness(points: ContactPoints, point: int) -> int:
    """Return the order of a root that is about as steep as damping at the edge is.

    It is 1 unless damping grows with a power of penetration below 1.
    """
    power = points.damping_exponent[point]
    steep = points.normal[point] == ONE_SIDED and points.damping[point] != 0.0
    if not (steep and 0.0 < power < 1.0):
        return 1
    return int(min(math.ceil(1.0 / power), STEEPEST))


@bare_kernel
def graded(before: float, behind: float) -> float:
    """Return how far a cell with a steep edge, or beside it, is graded, from 0 to 1.

    ``before`` and ``behind`` are the penetrations at its ends.
    """
    nearest, way = min(before, behind), BESIDE * abs(behind - before)
    if nearest >= way or max(before, behind) <= 0.0:
        return 0.0
    return float(min(1.0, 2.0 - 2.0 * nearest / way))
