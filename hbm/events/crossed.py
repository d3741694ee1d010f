"""What happens where a Floquet multiplier is on the unit circle (theory §6.4)."""

from __future__ import annotations

from hbm.events.moving_multiplier import outside
from microslip_mechanics.arrays import ComplexArray

REAL = 1e-6
"""imaginary part of a multiplier, over its modulus, below which it is real"""
BESIDE = 1e-3
"""distance from +1 within which one that is real may pair with another: one of a free
mean position that hardly decays is there all the time"""
TORUS, BRANCH = "Neimark-Sacker", "branch point"


def crossed(multiplier: complex, *, alone: bool = False) -> str:
    """Return what happens where a multiplier is on the unit circle.

    At +1, where the curve does not fold, another branch begins; at −1 a period doubles;
    elsewhere, together with its conjugate, a torus begins. One that crosses ``alone``
    has none: it has met that on the real axis before.
    """
    if not alone and turns(multiplier) and abs(multiplier - 1.0) > BESIDE:
        return TORUS
    return BRANCH if multiplier.real > 0.0 else "period doubling"


def crossings(before: ComplexArray, after: ComplexArray) -> range:
    """Return which Floquet multipliers cross the unit circle between two points.

    A multiplier is known by its place in the order of moduli, the largest first.
    """
    return range(*sorted((outside(before), outside(after))))


def turns(multiplier: complex) -> bool:
    """Return whether a multiplier has a conjugate beside it."""
    return abs(multiplier.imag) > REAL * abs(multiplier)
