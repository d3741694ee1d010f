"""A spring and a damper that pull and push: F = K xᵖ + C |ẋ|^q ẋ (theory, eq. 7a)."""

from __future__ import annotations

from typing import NamedTuple

from microslip_mechanics.jit import kernel


class PowerSpring(NamedTuple):
    """Power law of displacement beside a power law of speed."""

    stiffness: float
    """K [N/m^p]"""
    exponent: float
    """p; a whole even one gives a force that does not change its sign with x"""
    damping: float
    """C [N (s/m)^(q+1)]"""
    damping_exponent: float
    """q: 0 is a linear damper, 1 a quadratic one"""


@kernel
def power_force(
    law: PowerSpring, displacement: float, velocity: float
) -> tuple[float, float, float]:
    """Return force [N] and its derivatives by displacement and by velocity."""
    size = abs(displacement)
    sign = 1.0 if displacement >= 0.0 or law.exponent % 2.0 == 0.0 else -1.0
    lower = _power(size, law.exponent - 1.0)
    slope = law.exponent * law.stiffness * lower
    if displacement < 0.0 and sign > 0.0:
        slope = -slope
    rate = law.damping * _power(abs(velocity), law.damping_exponent)
    force = sign * law.stiffness * lower * size + rate * velocity
    return force, slope, (law.damping_exponent + 1.0) * rate


@kernel
def power_energy(law: PowerSpring, displacement: float) -> float:
    """Return the elastic energy [J] of the spring."""
    size = abs(displacement)
    energy = law.stiffness * _power(size, law.exponent + 1.0) / (law.exponent + 1.0)
    return -energy if displacement < 0.0 and law.exponent % 2.0 == 0.0 else energy


@kernel
def _power(base: float, exponent: float) -> float:
    """Return base**exponent for base ≥ 0, quickly for small whole exponents."""
    if exponent == 0.0:
        return 1.0
    if exponent == 1.0:
        return base
    if exponent == 2.0:
        return base * base
    if exponent == 4.0:
        return (base * base) * (base * base)
    return float(base**exponent)
