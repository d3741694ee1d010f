"""Places at which damping lets go of a contact before its faces part (theory §6.1)."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.normal import normal_response
from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from microslip_mechanics.jit import bare_kernel

BISECTIONS = 40
"""of a cell, until its place is known to rounding"""


@bare_kernel
def lets_go(points: ContactPoints, point: int) -> bool:
    """Return whether a contact may cease to press while its faces still touch."""
    damped = points.normal[point] == ONE_SIDED and points.damping[point] != 0.0
    return bool(damped and points.clamped[point])


@bare_kernel
def released(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    after: int,
) -> float:
    """Return the share of a cell at which such a contact lets go, or presses again.

    Zero if it does not, or if its faces touch there and press at once.
    """
    row = 3 * point
    depth, way = displacement[row, place], displacement[row, after]
    speed, faster = velocity[row, place], velocity[row, after]
    if depth <= points.gap[point]:
        return 0.0
    way, faster = way - depth, faster - speed
    pressed = normal_response(points, point, depth, speed)[0] > 0.0
    if pressed == (
        normal_response(points, point, depth + way, speed + faster)[0] > 0.0
    ):
        return 0.0
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        force, _, _ = normal_response(
            points, point, depth + middle * way, speed + middle * faster
        )
        if (force > 0.0) == pressed:
            low = middle
        else:
            high = middle
    return high
