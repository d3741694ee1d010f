"""The table of contact points and the one force law that both solvers call."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.coulomb import Coulomb, coulomb_coefficients
from microslip_mechanics.contact.gkf import GKF, gkf_coefficients
from microslip_mechanics.contact.hunt_crossley import (
    HuntCrossley,
    normal_force,
    spring_force,
)
from microslip_mechanics.jit import kernel

FRICTIONLESS, COULOMB, GENERAL_KINETIC = 0, 1, 2


class ContactPoints(NamedTuple):
    """Parameters of all contact points; each array has shape (points,)."""

    stiffness: Array
    """K [N/m^pK]"""
    exponent: Array
    """pK"""
    damping: Array
    """C [N s/m^(pD+1)]"""
    damping_exponent: Array
    """pD"""
    clamped: NDArray[np.bool_]
    """whether a pulling normal force is set to zero"""
    friction: NDArray[np.int64]
    """FRICTIONLESS, COULOMB or GENERAL_KINETIC"""
    dynamic: Array
    """µd"""
    static: Array
    """µs (GKF)"""
    stribeck: Array
    """V_str [m/s] (GKF)"""
    stribeck_exponent: Array
    """γ (GKF)"""
    viscous: Array
    """f_d [N s/m] (GKF)"""
    threshold: Array
    """V_lim [m/s]"""
    constant_load: NDArray[np.bool_]
    """whether friction uses ``load`` instead of the computed normal force"""
    load: Array
    """constant normal load of friction [N]"""


@kernel
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
        Written: the force [N] that resists them, shape ``(3,)``.
    by_displacement, by_velocity
        Written: ∂force/∂displacement [N/m], ∂force/∂velocity [N s/m], shape ``(3, 3)``.

    References
    ----------
    Theory page, eqs. (7)–(10).
    """
    normal, stiff, viscous = normal_force(
        normal_law(points, point), displacement[0], velocity[0]
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


@kernel
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
    spring = spring_force(normal_law(points, point), displacement[0])
    friction = force[1] * velocity[1] + force[2] * velocity[2]
    return friction, (force[0] - spring) * velocity[0]


@kernel
def contact_energy(points: ContactPoints, point: int, penetration: float) -> float:
    """Return the elastic energy [J] stored in the normal spring of one point."""
    spring = spring_force(normal_law(points, point), penetration)
    return float(spring * penetration / (points.exponent[point] + 1.0))


@kernel
def normal_law(points: ContactPoints, point: int) -> HuntCrossley:
    """Return the normal law of one row of the table."""
    return HuntCrossley(
        points.stiffness[point],
        points.exponent[point],
        points.damping[point],
        points.damping_exponent[point],
        points.clamped[point],
    )


@kernel
def _friction(
    points: ContactPoints, point: int, first: float, second: float
) -> tuple[float, float, float, float, float]:
    if points.friction[point] == COULOMB:
        coulomb = Coulomb(points.dynamic[point], points.threshold[point])
        return coulomb_coefficients(coulomb, first, second)
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
        Shape ``(3, 3)``: what the solvers need not carry for this point's laws.
    """
    by_displacement, by_velocity = np.zeros((2, 3, 3), dtype=bool)
    by_displacement[0, 0] = by_velocity[0, 0] = True
    if points.friction[point] != FRICTIONLESS:
        by_velocity[1:, 1:] = True
        if not points.constant_load[point]:
            by_displacement[1:, 0] = by_velocity[1:, 0] = True
    return by_displacement, by_velocity
