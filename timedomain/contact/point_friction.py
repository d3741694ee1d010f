"""Friction of one point as a projection, with its derivatives (theory, eq. 26c).

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

from microslip_mechanics.contact.gkf import GKF, gkf_coefficients
from microslip_mechanics.contact.points import COULOMB, TANH, ContactPoints
from microslip_mechanics.jit import inner_kernel


@inner_kernel
def friction(
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
    level, fall = _level(points, point, speed)
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


@inner_kernel
def _level(points: ContactPoints, point: int, speed: float) -> tuple[float, float]:
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
