"""The force along the normal of a contact point, by either of its laws."""

from __future__ import annotations

from microslip_mechanics.contact.hunt_crossley import (
    HuntCrossley,
    normal_force,
    spring_force,
)
from microslip_mechanics.contact.points import TWO_SIDED, ContactPoints
from microslip_mechanics.contact.power_spring import (
    PowerSpring,
    power_energy,
    power_force,
)
from microslip_mechanics.jit import bare_kernel


@bare_kernel
def normal_response(
    points: ContactPoints, point: int, displacement: float, velocity: float
) -> tuple[float, float, float]:
    """Return normal force [N] and its derivatives by displacement and by velocity."""
    depth = displacement - points.gap[point]
    if points.normal[point] == TWO_SIDED:
        return power_force(power_law(points, point), depth, velocity)
    return normal_force(normal_law(points, point), depth, velocity)


@bare_kernel
def spring_response(
    points: ContactPoints, point: int, displacement: float
) -> tuple[float, float]:
    """Return the elastic part of the normal force [N] and its derivative [N/m]."""
    depth = displacement - points.gap[point]
    if points.normal[point] == TWO_SIDED:
        pull, slope, _ = power_force(power_law(points, point), depth, 0.0)
        return pull, slope
    force = spring_force(normal_law(points, point), depth)
    return force, points.exponent[point] * force / depth if force > 0.0 else 0.0


@bare_kernel
def contact_energy(points: ContactPoints, point: int, penetration: float) -> float:
    """Return the elastic energy [J] stored in the normal spring of one point.

    ``penetration`` is the relative displacement along the normal [m].
    """
    depth = penetration - points.gap[point]
    if points.normal[point] == TWO_SIDED:
        return power_energy(power_law(points, point), depth)
    spring = spring_force(normal_law(points, point), depth)
    return float(spring * depth / (points.exponent[point] + 1.0))


@bare_kernel
def power_law(points: ContactPoints, point: int) -> PowerSpring:
    """Return the two-sided law of one row of the table."""
    return PowerSpring(
        points.stiffness[point],
        points.exponent[point],
        points.damping[point],
        points.damping_exponent[point],
    )


@bare_kernel
def normal_law(points: ContactPoints, point: int) -> HuntCrossley:
    """Return the one-sided law of one row of the table."""
    return HuntCrossley(
        points.stiffness[point],
        points.exponent[point],
        points.damping[point],
        points.damping_exponent[point],
        points.clamped[point],
    )
