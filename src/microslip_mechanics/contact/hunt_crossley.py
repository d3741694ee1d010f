"""Hunt and Crossley's normal law F = K δ^pK + C δ^pD δ̇ (theory, eq. 7)."""

from __future__ import annotations

import math
from typing import NamedTuple

from microslip_mechanics.jit import kernel


class HuntCrossley(NamedTuple):
    """Nonlinear spring with a damper that vanishes at the surface."""

    stiffness: float
    """K [N/m^pK]"""
    exponent: float
    """pK"""
    damping: float
    """C [N s/m^(pD+1)]"""
    damping_exponent: float
    """pD"""
    clamped: bool
    """whether a pulling force, possible at fast separation, is set to zero"""


@kernel
def normal_force(
    law: HuntCrossley, penetration: float, approach: float
) -> tuple[float, float, float]:
    """Return the normal force and its derivatives by penetration and by approach.

    ``penetration`` δ [m] is positive in contact, ``approach`` δ̇ [m/s] is its rate; the
    force [N] pushes the bodies apart. Zero out of contact (Hunt & Crossley, 1975).
    """
    if penetration <= 0.0:
        return 0.0, 0.0, 0.0
    spring = law.stiffness * power(penetration, law.exponent)
    rate = law.damping * power(penetration, law.damping_exponent)
    force = spring + rate * approach
    if law.clamped and force <= 0.0:
        return 0.0, 0.0, 0.0
    by_penetration = (
        law.exponent * spring + law.damping_exponent * rate * approach
    ) / penetration
    return force, by_penetration, rate


@kernel
def spring_force(law: HuntCrossley, penetration: float) -> float:
    """Return the elastic part K δ^pK [N] of the normal force."""
    if penetration <= 0.0:
        return 0.0
    return law.stiffness * power(penetration, law.exponent)


@kernel
def power(base: float, exponent: float) -> float:
    """Return base**exponent, quickly for the exponents that scenes use most."""
    if exponent == 2.0:
        return base * base
    if exponent == 1.0:
        return base
    if exponent == 0.5:
        return math.sqrt(base)
    if exponent == 1.5:
        return base * math.sqrt(base)
    return base**exponent  # type: ignore[no-any-return]
