"""Where a function changes its sign, by few of its values (theory §6)."""

from __future__ import annotations

import math
from collections.abc import Callable

PUSHED = 0.2
"""share of the bracket, squared, by which a secant's zero is pushed to the middle"""
SLACK = 1
"""values that may be taken beyond those of bisection"""


def bracketed(
    value: Callable[[float], float],
    low: float,
    high: float,
    *,
    xtol: float,
    rtol: float,
) -> float:
    """Return where a function changes its sign between two places.

    It is known to ``xtol``, or to ``rtol`` of itself. Where the function is smooth a
    few values are enough; where it leaps they are one more than for bisection. What is
    returned is not an end, if a value between was taken.

    References
    ----------
    Oliveira & Takahashi (2020), An enhancement of the bisection method average
    performance preserving minmax optimality, ACM Trans. Math. Softw. 47.
    """
    ends, place = (low, high), low
    first, last = value(low), value(high)
    near = max(xtol, rtol * max(abs(low), abs(high)))
    end = high - low
    most = near * 2.0 ** (math.ceil(math.log2(max(end / near, 1.0))) + SLACK - 1)
    while high - low > near:
        place = _tried(low, high, first, last, end, most)
        found = value(place)
        if found == 0.0:
            return place
        if (found > 0.0) == (first > 0.0):
            low, first = place, found
        else:
            high, last = place, found
        most *= 0.5
    inner = [each for each in (low, high) if each not in ends]
    known = {low: abs(first), high: abs(last)}
    return min(inner, key=known.__getitem__, default=place)


def _tried(
    low: float, high: float, first: float, last: float, end: float, most: float
) -> float:
    """Return where the next value is taken: interpolate, truncate, project.

    ``most`` is how far from the bracket's end it may be at the most.
    """
    middle, wide = 0.5 * (low + high), high - low
    secant = (last * low - first * high) / (last - first)
    side = math.copysign(1.0, middle - secant)
    pushed = min(PUSHED * wide * wide / end, abs(middle - secant))
    within = max(most - 0.5 * wide, 0.0)
    away = min(abs(middle - secant) - pushed, within)
    return middle - side * away
