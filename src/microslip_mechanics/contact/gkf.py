"""General kinetic friction (GKF): Stribeck's fall from µs to µd (theory, eq. 10)."""

from __future__ import annotations

import math
from typing import NamedTuple

from microslip_mechanics.jit import kernel


class GKF(NamedTuple):
    """Friction coefficient that falls with speed, regularised below a threshold."""

    dynamic: float
    """µd"""
    static: float
    """µs"""
    stribeck: float
    """V_str [m/s]"""
    exponent: float
    """γ"""
    threshold: float
    """V_lim [m/s]"""


@kernel
def gkf_coefficients(
    law: GKF, first: float, second: float
) -> tuple[float, float, float, float, float]:
    """Return friction per unit normal load and its derivatives by the sliding velocity.

    Arguments and results are those of
    :func:`~microslip_mechanics.contact.coulomb.coulomb_coefficients`; the coefficient
    is µd + (µs − µd) exp(−(|v|/V_str)^γ).
    """
    speed = math.hypot(first, second)
    if speed == 0.0:
        slope = law.static / law.threshold
        return 0.0, 0.0, slope, 0.0, slope
    exponent = (speed / law.stribeck) ** law.exponent
    fading = (law.static - law.dynamic) * math.exp(-exponent)
    coefficient = law.dynamic + fading
    fall = -fading * exponent * law.exponent / speed
    if speed <= law.threshold:
        ratio, bend = coefficient / law.threshold, fall / law.threshold
    else:
        ratio, bend = coefficient / speed, (fall - coefficient / speed) / speed
    one, two = first / speed, second / speed
    bend = bend * speed
    return (
        ratio * first,
        ratio * second,
        ratio + bend * one * one,
        bend * one * two,
        ratio + bend * two * two,
    )
