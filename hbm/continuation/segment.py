"""The part of a curve between two of its points, and the place of a zero on it.

It is parametrised by the distance along the tangent at the first point; a sign change
of a test function is refined by Brent's method, or by one that hardly takes more values
than bisection where it may leap, each of them being at a corrected point (theory §6.4).
"""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Callable
from dataclasses import dataclass, replace

from scipy.interpolate import KroghInterpolator
from scipy.optimize import brentq

from hbm.continuation.arc import plane_across, tangent
from hbm.continuation.bracket import bracketed
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import SingularError, System
from hbm.continuation.newton import Small, correct
from microslip_mechanics.arrays import Array

PRECISION, ROUGH, ROUGHER = 1e-5, 1e-3, 1e-2
"""of a located place, over the length of the step in which it is; the second where a
test function is less accurate than that, as with tangents of iterations, the third
where it is costly too; both where it may leap"""
LEAP, PARTS = 0.02, (0.5, 0.3, 0.7)
"""of the length of a step, by which a leap of a test function is known at least, and
places between two at which it may be asked for, the first that there is"""
NEAREST = 3
"""points through which a guess between them is interpolated"""
SURE = 0.1
"""of that: step of Newton's iteration that is the last one"""


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
    loose: float = 0.0
    """residual with which a point may do whose next step is too small to matter; no
    point may if it is zero"""
    tangents: bool = True
    """whether points between have the tangent that a test function may need"""

    @property
    def length(self) -> float:
        """Distance of the points along the tangent at the first."""
        return self.place(self.after.point)

    @property
    def precision(self) -> float:
        """The best of a located place: what tangents of iterations know is less."""
        return PRECISION if self.before.linearised.exact else ROUGH

    def locate(
        self,
        test: Callable[[Correction], float],
        ends: tuple[float, float] | None = None,
        precision: float | None = None,
        *,
        leaps: bool = False,
    ) -> Correction | None:
        """Return the point between the two at which ``test`` is zero.

        ``ends`` are its values at the two, if they are known better; ``precision`` is
        over the length of the step, the best if left out. None if it has no change of
        sign, or if a point between does not converge: where it may leap, because the
        residual does so by a little, the nearest one does beside it.
        """
        length, precision = self.length, precision or self.precision
        first, last = ends or (test(self.before), test(self.after))
        if not first * last < 0.0 or length <= 0.0:
            return None
        near, tested = precision * length, {0.0: first, length: last}
        solved: dict[float, Correction] = {}

        def value(place: float) -> float:
            if place <= 0.0:
                return first
            if place >= length:
                return last
            for each in solved.values():
                each.linearised.forget()
            solved[place] = self._at(self._guess(place, solved), near)
            tested[place] = test(solved[place])
            return tested[place]

        try:
            seek = bracketed if precision >= ROUGH else brentq
            root = seek(value, 0.0, length, xtol=near, rtol=1e-12)
            return solved.get(root) or self._at(self._guess(root, solved), near)
        except (_LostError, SingularError):
            place = _beside(tested, value) if leaps else None
            return None if place is None else solved.get(place)

    def across(self, guess: Array, near: float) -> Correction | None:
        """Return the point of the curve across a guess, with its tangent.

        It is known better than to ``near``; None if it does not converge.
        """
        try:
            return self._at(guess, near)
        except (_LostError, SingularError):
            return None

    def small(self, share: float) -> Small | None:
        """Return what Newton's iteration may neglect, by a share of the scale."""
        if self.loose == 0.0:
            return None
        return Small(lambda _: share * self.scale, self.loose)

    def place(self, point: Array) -> float:
        """Return the distance from the first point along its tangent."""
        along = self.before.along / self.scale
        return float(along @ ((point - self.before.point) / self.scale))

    def _guess(self, place: float, solved: dict[float, Correction]) -> Array:
        """Return about where the curve is at a distance, from the points nearest to it.

        As long as there are few, from both ends and the tangent at the first.
        """
        length = self.length
        ends = {0.0: self.before, length: self.after}
        points = {at: known.point for at, known in (ends | solved).items()}
        near = sorted(points, key=lambda at: abs(at - place))[:NEAREST]
        if len(near) == NEAREST:
            return KroghInterpolator(near, [points[at] for at in near])(place)
        start, direction = self.before.point, self.before.along
        bend = self.after.point - start - length * direction
        guess: Array = start + place * direction + (place / length) ** 2 * bend
        return guess

    def _at(self, guess: Array, near: float) -> Correction:
        direction = self.before.along
        found = correct(
            self.system,
            guess,
            plane_across(direction, self.scale),
            tolerance=self.tolerance,
            small=self.small(SURE * near),
        )
        if found.outcome is not Outcome.CONVERGED:
            raise _LostError
        if not self.tangents:
            return found
        return replace(found, tangent=tangent(found.linearised, direction, self.scale))


class _LostError(ArithmeticError):
    """A point between two others does not converge."""


def _beside(
    tested: dict[float, float], value: Callable[[float], float]
) -> float | None:
    """Return the place beside a change of sign at which a test function is smaller.

    The function, which adds to what is ``tested``, is asked for more until the change
    is known to :data:`LEAP` of the step; None if it is not to be had.
    """
    while True:
        low, high = next(
            (low, high)
            for low, high in itertools.pairwise(sorted(tested))
            if tested[low] * tested[high] <= 0.0
        )
        if high - low <= LEAP * max(tested):
            return min(low, high, key=lambda at: abs(tested[at]))
        known = len(tested)
        for part in PARTS:
            with contextlib.suppress(_LostError, SingularError):
                value(low + part * (high - low))
                break
        if len(tested) == known:
            return None


def folds(correction: Correction) -> float:
    """Return what is zero at a fold: the parameter's part of the tangent."""
    return float(correction.along[-1])
