"""Where a function changes its sign, by few of its values (theory §6.4)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeAlias

CLOSING = 0.9
"""of the precision: how far a value is taken from an end that a zero seems to be at"""
SLACK = 1
"""values that may be taken beyond those of bisection"""
Known: TypeAlias = tuple[float, float]
"""place and value"""


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
    few values are enough; where it leaps they are no more than for bisection, and one
    more where it is neither. What is returned is interpolated in the last bracket.

    References
    ----------
    Chandrupatla (1997), A new hybrid quadratic/bisection algorithm, Adv. Eng. Softw.
    28; the limit on its steps is that of Oliveira & Takahashi (2020), An enhancement of
    the bisection method average performance preserving minmax optimality, ACM Trans.
    Math. Softw. 47.
    """
    near = max(xtol, rtol * max(abs(low), abs(high)))
    halvings = math.ceil(math.log2(max((high - low) / near, 1.0)))
    most = near * 2.0 ** (halvings + SLACK - 1)
    one, two = (low, value(low)), (high, value(high))
    third: Known | None = None
    while abs(one[0] - two[0]) > near * (1.0 + 1e-9):
        place = _tried(one, two, third, near, most)
        found = place, value(place)
        if found[1] == 0.0:
            return place
        if (found[1] > 0.0) == (one[1] > 0.0):
            one, third = found, one
        else:
            one, two, third = found, one, two
        most *= 0.5
    return (one[0] * two[1] - two[0] * one[1]) / (two[1] - one[1])


def _tried(
    one: Known, two: Known, third: Known | None, near: float, most: float
) -> float:
    """Return where the next value is taken, between ``one``, the last, and ``two``.

    The bracket that is left is no longer than ``most`` then.
    """
    low, high = sorted((one[0], two[0]))
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    if third is None or not _monotone(one, two, third):
        return middle
    closest = min(CLOSING * near, half)
    inner = min(max(_interpolated(one, two, third), low + closest), high - closest)
    within = max(most - half, 0.0)
    return min(max(inner, middle - within), middle + within)


def _monotone(one: Known, two: Known, third: Known) -> bool:
    """Return whether the inverse parabola through three points is monotone."""
    place = (one[0] - two[0]) / (third[0] - two[0])
    share = (one[1] - two[1]) / (third[1] - two[1])
    if not 0.0 < share < 1.0:
        return False
    return share**2 < place and (1.0 - share) ** 2 < 1.0 - place


def _interpolated(one: Known, two: Known, third: Known) -> float:
    """Return where the inverse parabola through three points is zero."""
    size = max(abs(value) for _, value in (one, two, third))
    (first, a), (second, b), (last, c) = (
        (place, value / size) for place, value in (one, two, third)
    )
    return (
        first * b * c / ((a - b) * (a - c))
        + second * a * c / ((b - a) * (b - c))
        + last * a * b / ((c - a) * (c - b))
    )
