"""Points of a curve where something happens: peaks, folds, changes of stability.

Between two accepted points the curve is parametrised by the distance along the tangent
at the first; a sign change of a test function is refined by Brent's method, each of its
evaluations being a corrected point (theory §6).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.optimize

from hbm.continuation import tangent
from hbm.newton import Correction, Outcome, SingularError, System, correct
from microslip_mechanics.arrays import Array

PRECISION = 1e-5
"""of a located place, over the length of the step in which it is"""


@dataclass(frozen=True, slots=True)
class Segment:
    """Two neighbouring points of a curve."""

    system: System
    before: Correction
    after: Correction
    scale: Array
    """metric at the first, shape (n + 1,)"""
    tolerance: float
    """of the residual"""

    def locate(self, test: Callable[[Correction], float]) -> Correction | None:
        """Return the point between the two at which ``test`` is zero.

        None if it has no change of sign, or if a point between does not converge.
        """
        first, last = test(self.before), test(self.after)
        if not first * last < 0.0:
            return None
        length = self._place(self.after.point)
        latest: list[Correction] = []

        def value(place: float) -> float:
            if place <= 0.0:
                return first
            if place >= length:
                return last
            latest.append(self._at(place, length))
            return test(latest[-1])

        try:
            root = scipy.optimize.brentq(
                value, 0.0, length, xtol=PRECISION * length, rtol=1e-12
            )
            return self._at(float(root), length)
        except (_LostError, SingularError):
            return None

    def _place(self, point: Array) -> float:
        """Return the distance from the first point along its tangent."""
        along = self.before.along / self.scale
        return float(along @ ((point - self.before.point) / self.scale))

    def _at(self, place: float, length: float) -> Correction:
        """Return the point of the curve at a distance, with its tangent."""
        direction = self.before.along
        bend = self.after.point - self.before.point - length * direction
        guess = self.before.point + place * direction + (place / length) ** 2 * bend
        normal = direction / self.scale**2
        found = correct(
            self.system, guess, normal / np.abs(normal).max(), tolerance=self.tolerance
        )
        if found.outcome is not Outcome.CONVERGED:
            raise _LostError
        along = tangent(found.linearised, direction, self.scale)
        return Correction(
            found.point,
            found.residual,
            found.linearised,
            found.outcome,
            found.residuals,
            along,
        )


class _LostError(ArithmeticError):
    """A point between two others does not converge."""


def folds(correction: Correction) -> float:
    """Return what is zero at a fold: the parameter's part of the tangent."""
    return float(correction.along[-1])
