"""The one force law of contact points that both solvers call."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.coulomb import Coulomb, coulomb_coefficients
from microslip_mechanics.contact.gkf import GKF, gkf_coefficients
from microslip_mechanics.contact.normal import normal_response, spring_response
from microslip_mechanics.contact.points import (
    COULOMB,
    ELASTIC,
    FRICTIONLESS,
    GENERAL_KINETIC,
    ONE_SIDED,
    TANH,
    TWO_SIDED,
    ContactPoints,
)
from microslip_mechanics.contact.tanh_coulomb import tanh_coefficients
from microslip_mechanics.jit import bare_kernel, inner_kernel


@bare_kernel
def contact_force(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    force: Array,
    by_displacement: Array,
    by_velocity: Array,
) -> None:
    """Write the force of one contact point and its exact tangents.

    Parameters
    ----------
    points, point
        The table and the row in it.
    displacement, velocity
        Relative displacement [m] and velocity [m/s]: normal (positive in penetration)
        and two tangents, shape ``(3,)``.
    force
        Written: the force [N] that resists them, shape ``(3,)``; without the traction
        of what remembers (:mod:`~microslip_mechanics.contact.memory`) or is rigid.
    by_displacement, by_velocity
        Written: ∂force/∂displacement [N/m], ∂force/∂velocity [N s/m], shape ``(3, 3)``.

    References
    ----------
    Theory page, eqs. (7)–(10).
    """
    normal, stiff, viscous = normal_response(
        points, point, displacement[0], velocity[0]
    )
    force[:] = 0.0
    by_displacement[:] = 0.0
    by_velocity[:] = 0.0
    force[0], by_displacement[0, 0], by_velocity[0, 0] = normal, stiff, viscous
    if points.friction[point] == FRICTIONLESS:
        return
    load = points.load[point]
    if not points.constant_load[point]:
        if normal <= 0.0:
            return
        load = normal
    if points.friction[point] >= ELASTIC:
        for axis in range(1, 3):
            force[axis] = points.viscous[point] * velocity[axis]
            by_velocity[axis, axis] = points.viscous[point]
        return
    first, second, d11, d12, d22 = _friction(points, point, velocity[1], velocity[2])
    drag = 0.0
    if points.friction[point] == GENERAL_KINETIC:
        drag = points.viscous[point]
    force[1] = load * first + drag * velocity[1]
    force[2] = load * second + drag * velocity[2]
    by_velocity[1, 1] = load * d11 + drag
    by_velocity[1, 2] = by_velocity[2, 1] = load * d12
    by_velocity[2, 2] = load * d22 + drag
    if not points.constant_load[point]:
        by_displacement[1, 0], by_displacement[2, 0] = stiff * first, stiff * second
        by_velocity[1, 0], by_velocity[2, 0] = viscous * first, viscous * second


@bare_kernel
def regularised(points: ContactPoints, point: int) -> bool:
    """Return whether friction turns around within a threshold of the velocity."""
    return bool(FRICTIONLESS < points.friction[point] < ELASTIC)


@bare_kernel
def edge(points: ContactPoints, point: int) -> float:
    """Return the displacement [m] at which contact begins; −∞ if there is none."""
    if points.normal[point] == TWO_SIDED and points.friction[point] == FRICTIONLESS:
        return -math.inf
    return float(points.gap[point])


@bare_kernel
def sudden(points: ContactPoints, point: int) -> bool:
    """Return whether a force may jump where contact begins or ends.

    Damping does that does not grow with penetration, and viscous friction, unless it is
    always there.
    """
    if points.damping[point] != 0.0 and points.damping_exponent[point] == 0.0:
        return True
    return bool(points.viscous[point] != 0.0 and not points.constant_load[point])


@bare_kernel
def contact_power(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    force: Array,
) -> tuple[float, float]:
    """Return the power [W] that friction and normal damping take out.

    ``force`` is what :func:`contact_force` wrote for the same motion.
    """
    spring, _ = spring_response(points, point, displacement[0])
    friction = force[1] * velocity[1] + force[2] * velocity[2]
    return friction, (force[0] - spring) * velocity[0]


@bare_kernel
def damping_power(
    points: ContactPoints, point: int, displacement: float, velocity: float
) -> float:
    """Return the power [W] that normal damping takes out of a normal motion."""
    force, _, _ = normal_response(points, point, displacement, velocity)
    spring, _ = spring_response(points, point, displacement)
    return float((force - spring) * velocity)


@inner_kernel
def _friction(
    points: ContactPoints, point: int, first: float, second: float
) -> tuple[float, float, float, float, float]:
    if points.friction[point] == COULOMB:
        coulomb = Coulomb(points.dynamic[point], points.threshold[point])
        return coulomb_coefficients(coulomb, first, second)
    if points.friction[point] == TANH:
        smooth = Coulomb(points.dynamic[point], points.threshold[point])
        return tanh_coefficients(smooth, first, second)
    gkf = GKF(
        points.dynamic[point],
        points.static[point],
        points.stribeck[point],
        points.stribeck_exponent[point],
        points.threshold[point],
    )
    return gkf_coefficients(gkf, first, second)


def tangent_pattern(
    points: ContactPoints, point: int
) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
    """Return which tangents of a point can differ from zero.

    Returns
    -------
    by displacement, by velocity
        Shape ``(3, 3)``: what the solvers need not carry for this point's laws. Where
        a force jumps as faces touch, that is a tangent by displacement there alone.
    """
    by_displacement, by_velocity = np.zeros((2, 3, 3), dtype=bool)
    by_displacement[0, 0] = points.stiffness[point] != 0.0
    by_velocity[0, 0] = points.damping[point] != 0.0
    by_displacement[0, 0] |= by_velocity[0, 0] and points.normal[point] == ONE_SIDED
    if points.friction[point] >= ELASTIC:
        by_velocity[1, 1] = by_velocity[2, 2] = points.viscous[point] != 0.0
        by_displacement[1:, 0] = by_velocity[1, 1] and not points.constant_load[point]
    elif points.friction[point] != FRICTIONLESS:
        by_velocity[1:, 1:] = True
        if not points.constant_load[point]:
            by_displacement[1:, 0] = by_velocity[1:, 0] = True
    return by_displacement, by_velocity
