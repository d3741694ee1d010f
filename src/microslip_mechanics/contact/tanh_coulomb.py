"""Coulomb friction made smooth by a hyperbolic tangent (theory, eq. 9a)."""

from __future__ import annotations

import math

from microslip_mechanics.contact.coulomb import Coulomb
from microslip_mechanics.jit import kernel


@kernel
def tanh_coefficients(
    law: Coulomb, first: float, second: float
) -> tuple[float, float, float, float, float]:
    """Return friction per unit normal load and its derivatives by the sliding velocity.

    Arguments and results are those of
    :func:`~microslip_mechanics.contact.coulomb.coulomb_coefficients`; the coefficient
    is µ tanh(|v|/V_lim).
    """
    speed = math.hypot(first, second)
    share = speed / law.threshold
    if share < 1e-8:
        slope = law.coefficient / law.threshold
        return slope * first, slope * second, slope, 0.0, slope
    value = math.tanh(share)
    ratio = law.coefficient * value / speed
    along = law.coefficient * (1.0 - value * value) / law.threshold
    one, two = first / speed, second / speed
    return (
        ratio * first,
        ratio * second,
        along * one * one + ratio * two * two,
        (along - ratio) * one * two,
        along * two * two + ratio * one * one,
    )
