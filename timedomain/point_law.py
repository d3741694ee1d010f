"""The contact laws as the fast march linearises them: friction as a projection.

Regularised friction is the projection of a trial force on a disc. With the sliding
velocity v, the friction f, the radius R = µ N and the dashpot ε = V_lim / R,

    f = R d where |t| > R, else v / ε ,    t = f + ρ (v − ε f) ,   d = t / |t| ,

has the same solutions as f = R v / max(|v|, V_lim) for every 0 < ρ ≤ 1/ε. With
1/ρ = G + ε, where G is the compliance of the point over the step, the choice between
sticking and sliding is made by what friction is needed, and Newton's cost hardly
depends on V_lim (Alart & Curnier, 1991). ρ = 1/ε is the choice by velocity.
"""

from __future__ import annotations

import math

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.gkf import GKF, gkf_coefficients
from microslip_mechanics.contact.normal import normal_response, spring_response
from microslip_mechanics.contact.points import (
    COULOMB,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ONE_SIDED,
    TANH,
    ContactPoints,
)
from microslip_mechanics.jit import bare_kernel, inner_kernel


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
    one, two, d11, d12, d21, d22, per_one, per_two = _friction(
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


@inner_kernel
def _smooth_level(
    coefficient: float, share: float, threshold: float
) -> tuple[float, float]:
    """Return the level of smooth friction at a share of the threshold; its slope."""
    if share < 1e-4:
        return coefficient, 0.0
    value = math.tanh(share)
    steep = 1.0 - value * value
    if share > 1.0:
        return coefficient * value, coefficient * steep / threshold
    level = value / share
    return coefficient * level, coefficient * (steep - level) / share / threshold


@inner_kernel
def friction_level(
    points: ContactPoints, point: int, speed: float
) -> tuple[float, float]:
    """Return the coefficient µ that multiplies v / max(|v|, V_lim), and dµ/d|v|."""
    threshold = points.threshold[point]
    if points.friction[point] == COULOMB:
        return points.dynamic[point], 0.0
    if points.friction[point] == TANH:
        return _smooth_level(points.dynamic[point], speed / threshold, threshold)
    law = GKF(
        points.dynamic[point],
        points.static[point],
        points.stribeck[point],
        points.stribeck_exponent[point],
        threshold,
    )
    share, _, slope, _, _ = gkf_coefficients(law, speed, 0.0)
    if speed > threshold:
        return share, slope
    if speed == 0.0:
        return points.static[point], 0.0
    level = share * threshold / speed
    return level, (slope * threshold - level) / speed


@inner_kernel
def _friction(
    points: ContactPoints,
    point: int,
    weight: float,
    load: float,
    first: float,
    second: float,
    held_first: float,
    held_second: float,
) -> tuple[float, float, float, float, float, float, float, float]:
    """Return friction, its derivatives by the slip and those by the load.

    ``first``, ``second`` are the sliding velocity, ``held_first`` and ``held_second``
    the friction to begin with.
    """
    speed = math.hypot(first, second)
    level, fall = friction_level(points, point, speed)
    radius = level * load
    if radius <= 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    threshold = points.threshold[point]
    stiff = radius / threshold
    loss = stiff / (stiff + weight)
    one = loss * (held_first + weight * first)
    two = loss * (held_second + weight * second)
    trial = math.hypot(one, two)
    if trial <= radius:
        bend = fall * load / (threshold * speed) if speed > 0.0 else 0.0
        cross = bend * first * second
        per_load = level / threshold
        return (
            stiff * first,
            stiff * second,
            stiff + bend * first * first,
            cross,
            cross,
            stiff + bend * second * second,
            per_load * first,
            per_load * second,
        )
    one, two = one / trial, two / trial
    shrink = radius * loss / trial
    across = (held_first * two - held_second * one) * shrink / (1.0 - shrink)
    turn = shrink * weight / (1.0 - shrink)
    along = fall * load / speed if speed > 0.0 else 0.0
    return (
        radius * one - across * two,
        radius * two + across * one,
        turn * two * two + one * along * first,
        one * along * second - turn * one * two,
        two * along * first - turn * one * two,
        turn * one * one + two * along * second,
        level * one,
        level * two,
    )
