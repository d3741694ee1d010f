"""A point from which a curve goes on, or begins, where Newton resists (theory §6.2)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from hbm.continuation.arc import Metric, distance
from hbm.continuation.corrected import correct_at
from hbm.continuation.correction import Correction
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.grown import Resolved
from hbm.curves.homotopy import approaches
from hbm.curves.onwards import onwards
from hbm.errors import ContinuationError
from hbm.paths.path import Path
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array, largest

LEAPS = (1e-4, 1e-3, 5e-3, 2e-2, 5e-2)
"""shares of the range by which a restart passes what resists, tried in turn; from the
first one again where the piece before has come nearer to the end"""
FIRST = (0.0, 1e-2)
"""the same where there is no curve yet"""
FOLDED = (0.0, LEAPS[0], LEAPS[-1])
"""leaps behind which a first point is also sought through folds of the drive, which
takes thousands of evaluations where there is none"""
BACK = (1, 3, 6, 9, 12, 16, 24, 32)
"""points of the way at which more harmonics are tried, counted from the last one"""
ALIKE = 0.03
"""relative difference up to which two points at one place are one"""
TENTHS = 10
"""units of a parameter in its range, or in the logarithm of that"""


class Beginning(NamedTuple):
    """How a piece of a curve begins."""

    guess: Array
    """shape (n + 1,)"""
    direction: Array | None
    """in which it goes, shape (n + 1,); towards the end if none"""
    control: StepControl
    replaces: int = 0
    """how many points of the way before are taken back"""


@dataclass(frozen=True, slots=True)
class Restart:
    """Where a curve along a path begins anew: a few points back, or behind a leap."""

    path: Path
    system: AdaptiveBalance
    control: StepControl
    effort: Effort
    metric: Metric
    resolved: Resolved | None
    """what makes the system of another path"""

    def point(
        self, reached: float, heading: float, leaps: Iterator[float]
    ) -> Array | None:
        """Return a point from which the curve can go on, past what resists.

        ``leaps`` are what is left to try, in shares of the range.
        """
        way = self._way(reached, heading)
        for leap in leaps:
            parameter = reached + leap * way
            if (heading - parameter) * way <= 0.0:
                return None
            for coefficients in approaches(
                self.path,
                parameter,
                self.control,
                self.effort,
                self.metric,
                folded=leap in FOLDED,
                resolved=self.resolved if leap == 0.0 else None,
            ):
                settled = self.settled(coefficients, parameter)
                if settled is not None:
                    return settled
        return None

    def finer(
        self, way: Sequence[Correction], control: StepControl
    ) -> Beginning | None:
        """Return the last point of a way that more harmonics have too.

        They are found without neglecting steps of Newton's iteration; the system keeps
        the harmonics, and points behind are taken back. None if there is no such point,
        or if ``control``, that of the way, and the system were like that already.
        """
        strict = control.strict
        if not way or (not self.system.raise_floor() and control == strict):
            return None
        for back in dict.fromkeys(min(each, len(way)) for each in BACK):
            known = way[-back]
            guess = known.point if known.reported is None else known.reported
            try:
                found = correct_at(self.system, guess, strict)
            except ContinuationError:
                continue
            scale = self.metric(guess)
            if distance(found.point, guess, scale) <= control.shift:
                come = way[: len(way) - back + 1]
                on = onwards(self.system, come, found.point, scale, strict)
                return Beginning(guess, on, strict, back - 1)
        return None

    def behind(
        self,
        reached: float,
        begun: Beginning,
        heading: float,
        left: Iterator[float],
    ) -> tuple[Iterator[float], Beginning | None]:
        """Return the leaps to try, and a point behind where a piece came to, if any.

        All leaps if that is nearer to the end than its beginning, else those ``left``.
        """
        first = float(begun.guess[-1])
        nearer = (reached - first) / self._way(first, heading) > LEAPS[0]
        leaps = iter(LEAPS) if nearer else left
        guess = self.point(reached, heading, leaps)
        return leaps, None if guess is None else Beginning(guess, None, self.control)

    def settled(self, coefficients: Array, parameter: float) -> Array | None:
        """Return the point near a coarse response; None if it does not converge.

        Harmonics for which a point has no room are left out.
        """
        guess = self.still(parameter)
        kept = coefficients.ravel()[: guess.size - 1]
        guess[: kept.size] = kept
        self.system.restart(coefficients.shape[0] // 2)
        try:
            found = correct_at(
                self.system, guess, self.control, self.system, self.metric
            )
        except ContinuationError:
            return None
        self.system.fourier = self.system.settled  # with less it may not be found again
        return found.point

    def besides(self, guess: Array, known: Sequence[Array]) -> Array | None:
        """Return the point to which a guess leads, besides those known at its place.

        None if it is about one of them, or none.
        """
        self.system.restart(self.system.fourier.harmonics)
        try:
            found = correct_at(
                self.system, guess, self.control, self.system, self.metric
            ).point
        except ContinuationError:
            return None
        self.system.fourier = self.system.settled  # with less it may not be found again
        return None if any(self._alike(found, each) for each in known) else found

    def _alike(self, one: Array, other: Array) -> bool:
        """Return whether two points at one place are the same, to the tolerance.

        They are if what lies half way between them balances too: without drive rest is
        one of those.
        """
        if distance(one, other, self.metric(other)) <= ALIKE:
            return True
        residual, _ = self.system(0.5 * (one + other))
        return largest(residual) <= self.control.tolerance

    def still(self, parameter: float) -> Array:
        """Return the point at rest."""
        problem, _ = self.path.at(parameter)
        point = np.zeros(self.system.size)
        point[: problem.rank], point[-1] = problem.rest, parameter
        return point

    def _way(self, place: float, heading: float) -> float:
        """Return the range, or the share of it that counts like that at a place."""
        return math.copysign(TENTHS * self.path.unit(place), heading - place)
