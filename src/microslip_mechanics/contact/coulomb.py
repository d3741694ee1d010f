"""Regularised Coulomb friction in two tangential directions (theory, eq. 9)."""

from __future__ import annotations

import math
from typing import NamedTuple

from microslip_mechanics.jit import kernel


class Coulomb(NamedTuple):
    """Constant friction coefficient, proportional to the speed below a threshold."""

    coefficient: float
    """µd"""
    threshold: float
    """V_lim [m/s]"""


@kernel
def coulomb_coefficients(
    law: Coulomb, first: float, second: float
) -> tuple[float, float, float, float, float]:
    """Return friction per unit normal load and its derivatives by the sliding velocity.

    Parameters
    ----------
    law
        Coefficient and threshold.
    first, second
        Sliding velocity along the two tangents [m/s].

    Returns
    -------
    first, second
        µ v / max(|v|, V_lim) along the two tangents; it resists the sliding.
    first_by_first, first_by_second, second_by_second
        Its symmetric derivative [s/m].
    """
    speed = math.hypot(first, second)
    if speed <= law.threshold:
        slope = law.coefficient / law.threshold
        return slope * first, slope * second, slope, 0.0, slope
    ratio = law.coefficient / speed
    one, two = first / speed, second / speed
    return (
        ratio * first,
        ratio * second,
        ratio * two**2,
        -ratio * one * two,
        ratio * one**2,
    )
