"""A point where a curve has been, and what of it is compared (theory §6.2)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array

ASIDE = 0.1
"""length of a step from which it may pass a point, over its own"""
HEAD = 64
"""components of points, the first ones, that are compared with all that is known"""


class Known(NamedTuple):
    """A point where the curve has been, without the zeros of orders that it leaves out.

    There is room for far more components than most points of a long curve have.
    """

    point: Array
    along: Array
    """its unit tangent there"""

    def whole(self, size: int) -> Known:
        """Return it with all components."""
        return Known(lengthened(self.point, size), lengthened(self.along, size))

    def with_only(self, has: NDArray[np.bool_]) -> Known:
        """Return it without what a coarser point has not."""
        return Known(np.where(has, self.point, 0.0), np.where(has, self.along, 0.0))

    def passed(
        self, before: Array, step: Array, scale: Array
    ) -> tuple[float, bool] | None:
        """Return the share of a step at which it passes the point, or None.

        And whether it does so in the direction of the tangent there. ``step`` is in
        units of the ``scale``.
        """
        length = float(np.linalg.norm(step))
        away = (self.point - before) / scale
        share = float(step @ away) / length**2
        aside = float(np.linalg.norm(away - share * step))
        straight = float((self.along / scale) @ step) / length
        if not (0.0 < share <= 1.0 and aside < ASIDE * length and abs(straight) > 0.5):
            return None
        return share, straight > 0.0

    def across(self, guess: Array, scale: Array) -> Array:
        """Return the point to which a guess moves in the plane across this one."""
        along = self.along / scale
        way = float(along @ ((self.point - guess) / scale))
        moved: Array = guess + way / float(along @ along) * self.along
        return moved


def head(vector: Array) -> Array:
    """Return the first components and the parameter."""
    return np.append(vector[: min(HEAD, vector.size - 1)], vector[-1])


def shortened(vector: Array) -> Array:
    """Return a vector without the zeros before its parameter."""
    kept = np.flatnonzero(vector[:-1])
    return np.append(vector[: kept[-1] + 1 if kept.size else 0], vector[-1])


def lengthened(vector: Array, size: int) -> Array:
    """Return a shortened vector as it was."""
    whole = np.zeros(size)
    whole[: vector.size - 1], whole[-1] = vector[:-1], vector[-1]
    return whole
