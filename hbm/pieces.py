"""A trace that begins by homotopy, and begins again, where Newton resists (§6)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.adaptive import AdaptiveBalance
from hbm.continuation import ContinuationError, StepControl, trace
from hbm.homotopy import approached
from hbm.newton import Correction
from hbm.relative import RelativeProblem
from microslip_mechanics.arrays import Array

RESTARTS = 6
"""that a curve may take before it is given up"""
LEAPS = (1e-4, 1e-3, 5e-3, 2e-2)
"""shares of the range by which a restart passes what resists, tried in turn"""


@dataclass(frozen=True, slots=True)
class Pieces:
    """The corrections along a curve from ``start`` to ``end``, in order."""

    problem: RelativeProblem
    active: NDArray[np.bool_]
    """coefficients of the probing orders that move, (11, rank)"""
    system: AdaptiveBalance
    start: float
    """[rad/s]"""
    end: float
    control: StepControl

    def __iter__(self) -> Iterator[Correction]:
        """Yield corrections; the first of a new piece has no tangent before it."""
        begin, guess = self.start, self._still(self.start)
        for attempt in range(RESTARTS + 1):
            last = math.nan
            try:
                for correction in self._traced(guess):
                    last = float(correction.point[-1])
                    yield correction
            except ContinuationError as error:
                if attempt == RESTARTS:
                    raise
                reached = begin if math.isnan(last) else last
                again = self._again(reached, first=math.isnan(last) and attempt == 0)
                if again is None:
                    raise ContinuationError(str(error)) from None
                begin, guess = float(again[-1]), again
            else:
                return

    def metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc.

        Relative changes of mean motion and vibration each, and a tenth of the range: a
        preload makes mean values large, and must not hide the vibration.
        """
        means = self.problem.rank
        scale = np.full(point.size, float(np.linalg.norm(point[means:-1])) + 1e-15)
        scale[:means] = float(np.linalg.norm(point[:means])) + 1e-15
        scale[-1] = abs(self.end - self.start) / 10.0
        return scale

    def _traced(self, guess: Array) -> Iterator[Correction]:
        return trace(
            self.system,
            guess,
            self.end,
            metric=self.metric,
            control=self.control,
            settler=self.system,
            begin=self.start,
        )

    def _again(self, reached: float, *, first: bool) -> Array | None:
        """Return a point from which the curve can go on, past what resists."""
        for leap in (0.0, *LEAPS) if first else LEAPS:
            frequency = reached + leap * (self.end - self.start)
            if (self.end - frequency) * (self.end - self.start) <= 0.0:
                return None
            found = approached(self.problem, self.active, frequency, self.control)
            for _, coefficients in found:
                guess = self._still(frequency)
                guess[: coefficients.size] = coefficients.ravel()
                self.system.restart(coefficients.shape[0] // 2)
                return guess
        return None

    def _still(self, frequency: float) -> Array:
        """Return the point at rest."""
        point = np.zeros(self.system.size)
        point[: self.problem.rank], point[-1] = self.problem.rest, frequency
        return point
