"""Contact laws as the fast march linearises them, friction as a projection (§7.2)."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.normal import normal_response, spring_response
from microslip_mechanics.contact.points import (
    FRICTIONLESS,
    GENERAL_KINETIC,
    ONE_SIDED,
    ContactPoints,
)
from microslip_mechanics.jit import bare_kernel
from timedomain.contact.point_friction import friction


@bare_kernel
def linearise(
    points: ContactPoints,
    point: int,
    weight: float,
    careful: bool,
    begins: Array,
    gaps: Array,
    slips: Array,
    forces: Array,
    lines: Array,
    by_gap: Array,
    by_slip: Array,
) -> None:
    """Write the force of one point, linear about a motion and a friction force.

    Parameters
    ----------
    points, point
        The table and the row in it and in what follows.
    weight
        1/G [N s/m].
    careful
        Whether the slope of normal damping by penetration is a secant through zero
        where it is positive, and zero where it is negative: near first touch and
        separation its tangent, which grows without bound, makes Newton cycle.
    begins
        Penetrations at the begin of the step, (points,), if ``gaps`` and ``slips`` are
        means over it; else empty.
    gaps, slips
        Relative displacement and velocity: normal and two tangents, (points, 3).
    forces
        Where to begin, (points, 3): its friction chooses between stick and slip.
    lines
        Written: the force at ``gaps`` and ``slips``, (points, 3).
    by_gap, by_slip
        Written: derivatives by the normal displacement, (points, 3), and by the
        velocity, (points, 3, 3).
    """
    depth, approach = gaps[point, 0], slips[point, 0]
    normal, stiff, viscous = normal_response(points, point, depth, approach)
    inside = depth - points.gap[point]
    if careful and points.normal[point] == ONE_SIDED and inside > 0.0:
        _, stiff = spring_response(points, point, depth)
        stiff += max(0.0, viscous * approach / inside)
    if begins.size > 0:
        more, stiffer = between(points, point, begins[point], depth)
        normal, stiff = normal + more, stiff + stiffer
    lines[point, 0], by_gap[point, 0], by_slip[point, 0, 0] = normal, stiff, viscous
    load = normal
    if points.constant_load[point]:
        load = points.load[point]
    if points.friction[point] == FRICTIONLESS or load <= 0.0:
        load = 0.0
    drag = 0.0
    rubs = points.constant_load[point] or load > 0.0
    if points.friction[point] == GENERAL_KINETIC and rubs:
        drag = points.viscous[point]
    first, second = slips[point, 1], slips[point, 2]
    one, two, d11, d12, d21, d22, per_one, per_two = friction(
        points,
        point,
        weight,
        load,
        first,
        second,
        forces[point, 1] - drag * first,
        forces[point, 2] - drag * second,
    )
    if points.constant_load[point]:
        per_one = per_two = 0.0
    lines[point, 1], lines[point, 2] = one + drag * first, two + drag * second
    by_gap[point, 1], by_gap[point, 2] = stiff * per_one, stiff * per_two
    by_slip[point, 1, 0], by_slip[point, 2, 0] = viscous * per_one, viscous * per_two
    by_slip[point, 1, 1], by_slip[point, 1, 2] = d11 + drag, d12
    by_slip[point, 2, 1], by_slip[point, 2, 2] = d21, d22 + drag


@bare_kernel
def between(
    points: ContactPoints, point: int, begin: float, mean: float
) -> tuple[float, float]:
    """Return what the mean spring force of a step exceeds that of its mean by.

    By Simpson's rule over the penetration, which keeps the spring's energy where the
    force is a cubic; with the derivative by the mean penetration.
    """
    first, _ = spring_response(points, point, begin)
    middle, rises = spring_response(points, point, mean)
    last, rise = spring_response(points, point, 2.0 * mean - begin)
    return (first + last - 2.0 * middle) / 6.0, (rise - rises) / 3.0
