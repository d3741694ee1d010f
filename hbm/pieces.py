"""A trace that begins by homotopy, and begins again, where Newton resists (§6)."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hbm.adaptive import AdaptiveBalance
from hbm.continuation import correct_at, trace
from hbm.corner import round_corner
from hbm.effort import Effort
from hbm.errors import PLACE, ContinuationError
from hbm.homotopy import approaches
from hbm.newton import Correction
from hbm.path import Path
from hbm.step_control import StepControl
from microslip_mechanics.arrays import Array

RESTARTS = 6
"""that a curve may take before it is given up"""
REMEMBERED = 60
"""points behind the last one, by which the way to a corner is known"""
CORNERS = 30
"""that a piece may turn round before it is given up"""
LEAPS = (1e-4, 1e-3, 5e-3, 2e-2, 5e-2)
"""shares of the range by which a restart passes what resists, tried in turn; from the
first one again where the piece before has come nearer to the end"""
PUSHES = 10.0
"""of a push on rigid contacts, over that of a motion: change that counts as one unit of
arc; it jumps, so that every harmonic that is added changes it"""
FIRST = (0.0, 1e-2)
"""the same where there is no curve yet"""
FOLDED = (0.0, LEAPS[0], LEAPS[-1])
"""leaps behind which a first point is also sought through folds of the drive, which
takes thousands of evaluations where there is none"""


@dataclass(frozen=True, slots=True)
class Pieces:
    """The corrections along a curve from ``start`` to ``end``, in order.

    A curve that folds back and returns to ``start``, that stops, or that does not
    begin, is followed from ``end`` as well; in the last case if Newton's iteration
    from rest begins it there. If both return, what lies between is sought.
    """

    path: Path
    system: AdaptiveBalance
    start: float
    """parameter at which the curve begins"""
    end: float
    control: StepControl
    effort: Effort

    def __iter__(self) -> Iterator[Correction]:
        """Yield corrections; the first of a new piece has no tangent before it."""
        there: list[float] = []
        stopped: ContinuationError | None = None
        try:
            yield from self._noted(self._from(self.start, self.end), there)
        except ContinuationError as error:
            stopped = error
        if stopped is None and there[-1:] in ([], [1.0]):
            return
        back: list[float] = []
        again = FIRST if there else ()
        try:
            yield from self._noted(self._from(self.end, self.start, again), back)
        except ContinuationError as error:
            raise stopped or error from None
        if back[-1:] in ([], [0.0]):
            return
        if stopped is not None:
            raise stopped
        if max(there) < min(back):
            yield from self._between(max(there))

    def _noted(
        self, corrections: Iterator[Correction], shares: list[float]
    ) -> Iterator[Correction]:
        """Yield corrections, and note the share of the range before each of them."""
        for each in corrections:
            shares.append(
                (float(each.point[-1]) - self.start) / (self.end - self.start)
            )
            yield each

    def _between(self, reached: float) -> Iterator[Correction]:
        """Yield corrections from beyond where curves from both ends turn back.

        ``reached`` is the share of the range up to where the first does.
        """
        where = self.start + reached * (self.end - self.start)
        guess = self._again(where, self.end, iter(LEAPS))
        last: Correction | None = None
        if guess is not None:
            for last in self._cornered(guess, self.end):
                yield last
        if last is None or last.point[-1] != self.end:
            raise ContinuationError(
                f"the curve turns back at {PLACE}, and that from the other end of the "
                "range before it comes there: what lies between was not found; a "
                "smaller tolerance, or more harmonics, may lead round the corner",
                where,
            )

    def _from(
        self, begin: float, end: float, first: tuple[float, ...] = FIRST
    ) -> Iterator[Correction]:
        """Yield corrections from one end of the range, past what resists.

        ``first`` are the leaps by which a first point is sought if there is none.
        """
        guess, heading, leaps = self._still(begin), end, iter(first)
        for attempt in range(RESTARTS + 1):
            last: Correction | None = None
            try:
                for correction in self._cornered(guess, heading):
                    last = correction
                    yield correction
            except ContinuationError:
                heading = self._onwards(last, heading)
                reached = float((guess if last is None else last.point)[-1])
                leaps = self._leaps(float(guess[-1]), reached, heading, leaps)
                again = self._again(reached, heading, leaps)
                if again is None or attempt == RESTARTS:
                    raise
                guess = again
            else:
                return

    def from_point(self, guess: Array, direction: Array) -> Iterator[Correction]:
        """Yield corrections from a point in a direction, until the range ends.

        Or until the curve closes.
        """
        yield from trace(
            self.system,
            guess,
            self.end,
            metric=self.metric,
            control=replace(self.control, most_points=1000),
            settler=self.system,
            begin=self.start,
            direction=direction,
        )

    def metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc.

        Relative changes of mean motion and vibration each, and a tenth of the range: a
        preload makes mean values large, and must not hide the vibration. Means that
        are smaller than it count like it. Pushes on rigid contacts count less.
        """
        means = self.path.rank
        vibration = float(np.linalg.norm(point[means:-1])) + 1e-15
        scale = np.full(point.size, vibration)
        scale[:means] = max(float(np.linalg.norm(point[:means])), vibration)
        tractions = self.path.at(float(point[-1]))[0].tractions
        if tractions is not None:
            pushes = scale[:-1].reshape(-1, means)[:, tractions.rows.shape[1] :]
            pushes *= PUSHES
        scale[-1] = self.path.unit(float(point[-1]))
        return scale

    def _cornered(self, guess: Array, heading: float) -> Iterator[Correction]:
        """Yield corrections of one piece, round its corners."""
        direction: Array | None = None
        turns = False
        way: deque[Correction] = deque(maxlen=REMEMBERED)
        for corner in range(CORNERS + 1):
            try:
                for correction in self._traced(guess, heading, direction):
                    joined = correction.joined or direction is not None
                    way.append(replace(correction, joined=joined, turns=turns))
                    yield way[-1]
                    turns = False
            except ContinuationError:
                if not way or corner == CORNERS:
                    raise
                turned = round_corner(
                    self.system, way, self.metric, self.control.tolerance
                )
                if turned is None:
                    raise
                guess, direction, turns = turned
            else:
                return

    def _traced(
        self, guess: Array, heading: float, direction: Array | None
    ) -> Iterator[Correction]:
        return trace(
            self.system,
            guess,
            heading,
            metric=self.metric,
            control=self.control,
            settler=self.system,
            begin=self.start if heading == self.end else self.end,
            direction=direction,
        )

    def _onwards(self, last: Correction | None, heading: float) -> float:
        """Return the end of the range to which the curve was going."""
        if last is None or last.along[-1] == 0.0:
            return heading
        onwards = math.copysign(1.0, last.along[-1])
        return max(self.start, self.end, key=lambda each: onwards * each)

    def _leaps(
        self, begun: float, reached: float, heading: float, left: Iterator[float]
    ) -> Iterator[float]:
        """Return the leaps to try: all of them if the last piece came nearer."""
        way = math.copysign(self.end - self.start, heading - begun)
        return iter(LEAPS) if (reached - begun) / way > LEAPS[0] else left

    def _again(
        self, reached: float, heading: float, leaps: Iterator[float]
    ) -> Array | None:
        """Return a point from which the curve can go on, past what resists.

        ``leaps`` are what is left to try, in shares of the range.
        """
        way = math.copysign(abs(self.end - self.start), heading - reached)
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
            ):
                settled = self._settled(coefficients, parameter)
                if settled is not None:
                    return settled
        return None

    def _settled(self, coefficients: Array, parameter: float) -> Array | None:
        """Return the point near a coarse response; None if it does not converge.

        Harmonics for which a point has no room are left out.
        """
        guess = self._still(parameter)
        kept = coefficients.ravel()[: guess.size - 1]
        guess[: kept.size] = kept
        self.system.restart(coefficients.shape[0] // 2)
        try:
            found = correct_at(
                self.system, guess, self.control, self.system, self.metric
            )
        except ContinuationError:
            return None
        return found.point

    def _still(self, parameter: float) -> Array:
        """Return the point at rest."""
        problem, _ = self.path.at(parameter)
        point = np.zeros(self.system.size)
        point[: problem.rank], point[-1] = problem.rest, parameter
        return point
