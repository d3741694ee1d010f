"""Where a function changes its sign, by few of its values (theory §6)."""

from __future__ import annotations

import math
from collections.abc import Callable

CLOSING = 0.9
"""of the precision: how far a value is taken from an end that a zero seems to be at"""
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
    Anderson & Björck (1973), A new high order method of regula falsi type, BIT 13; the
    limit on its steps is that of Oliveira & Takahashi (2020), An enhancement of the
    bisection method average performance preserving minmax optimality, ACM Trans. Math.
    Softw. 47.
    """
    ends, known = (low, high), {low: value(low), high: value(high)}
    first, last = known[low], known[high]
    near = max(xtol, rtol * max(abs(low), abs(high)))
    halvings = math.ceil(math.log2(max((high - low) / near, 1.0)))
    most = near * 2.0 ** (halvings + SLACK - 1)
    while high - low > near * (1.0 + 1e-9):
        place = _tried(low, high, first, last, near, most)
        found = known[place] = value(place)
        if found == 0.0:
            return place
        if (found > 0.0) == (first > 0.0):
            last *= _share(found, first)
            low, first = place, found
        else:
            first *= _share(found, last)
            high, last = place, found
        most *= 0.5
    inner = [each for each in (low, high) if each not in ends]
    return min(inner, key=lambda each: abs(known[each]), default=low)


def _share(found: float, before: float) -> float:
    """Return by how much the value at the other end counts less: it may be stale."""
    share = 1.0 - found / before
    return share if share > 0.0 else 0.5


def _tried(
    low: float, high: float, first: float, last: float, near: float, most: float
) -> float:
    """Return where the next value is taken.

    The bracket that is left is no longer than ``most`` then.
    """
    secant = (last * low - first * high) / (last - first)
    closest = min(CLOSING * near, 0.5 * (high - low))
    secant = min(max(secant, low + closest), high - closest)
    middle, within = 0.5 * (low + high), max(most - 0.5 * (high - low), 0.0)
    return min(max(secant, middle - within), middle + within)
