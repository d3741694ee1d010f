"""Where a curve comes in from beyond its range, in which it folds (theory §6.2)."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator
from dataclasses import replace

from hbm.continuation.cornered import Cornered
from hbm.continuation.settler import UNSETTLED
from hbm.continuation.tracing import Tracing
from hbm.curves.restart import Restart
from hbm.errors import ContinuationError
from hbm.paths.path import AlongFrequency
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

BEYOND, NEAR, LEAST = 0.5, 0.05, 0.5
"""share of the range that is looked at beyond each end, share of the frequency there
that is at the least, and at the most towards lower ones"""
STEPS, LOOKS, ROUGHLY = 5, 100, 3
"""longest steps in that, most points, and their harmonics: none of them is reported"""
MOST = 8
"""points at which the range is left"""


class Incoming:
    """The points at which what has left a range comes in again, as they are found.

    Between two folds a range has three responses at its end, and a curve that arrives
    there with one of them lacks the others, with which it hangs together beyond.
    """

    def __init__(self, restart: Restart, start: float, end: float) -> None:
        """Take the ends of the range, and what begins a curve anew there."""
        self._restart, self._start, self._end = restart, start, end
        self._seen: list[Array] = []
        self._left: deque[Array] = deque()
        self._asked: list[Array] = []

    def leave(self, point: Array) -> None:
        """Note that the range was left at a point, if it is at one of its ends."""
        if point[-1] in (self._start, self._end) and len(self._seen) < MOST:
            self._left.append(point)
            self._seen.append(point)

    def ask(self, guess: Array) -> None:
        """Note a guess at one of the ends, such as rest, from which a test begins."""
        self._asked.append(guess)

    def __iter__(self) -> Iterator[tuple[Array, float]]:
        """Yield points of other responses at the ends, and the end a curve heads for.

        First those to which what was asked for leads; then what comes back where the
        range was left.
        """
        while self._asked:
            yield from self._besides(self._asked.pop())
        while self._left:
            returned = self._returned(self._left.popleft())
            if returned is not None:
                yield from self._besides(returned)

    def _besides(self, guess: Array) -> Iterator[tuple[Array, float]]:
        """Yield the point to which a guess leads, unless it has been seen."""
        here = [each for each in self._seen if each[-1] == guess[-1]]
        found = self._restart.besides(guess, here)
        if found is not None:
            self._seen.append(found)
            yield found, self._start if guess[-1] == self._end else self._end

    def _returned(self, known: Array) -> Array | None:
        """Return about where a curve comes back that leaves the range at a known point.

        None if it does not fold soon, or if there are no problems beyond the range; no
        parameter is taken to zero, or looked for below it.
        """
        restart, here = self._restart, float(known[-1])
        if here <= 0.0:
            return None
        width = max(BEYOND * abs(self._end - self._start), NEAR * here)
        outwards = math.copysign(width, 2.0 * here - self._start - self._end)
        until = max(here + outwards, LEAST * here)
        system = self._system(until)
        if system is None:
            return None

        def metric(point: Array) -> Array:
            scale = restart.metric(point)
            scale[-1] = width / STEPS
            return scale

        system.restart(ROUGHLY)
        way = Tracing(
            system,
            until,
            here,
            metric,
            replace(restart.control, initial=1.0, largest=1.0, most_points=LOOKS),
            UNSETTLED,
        )
        try:
            (last,) = deque(Cornered(way, known), maxlen=1)
        except ContinuationError:
            return None
        return last.point if last.point[-1] == here else None

    def _system(self, until: float) -> AdaptiveBalance | None:
        """Return what is traced up to a place beyond the range, if there is such."""
        restart, path = self._restart, self._restart.path
        if isinstance(path, AlongFrequency):
            return restart.system  # there is one problem, at any frequency
        from hbm.paths.along_parameter import AlongParameter

        if restart.resolved is None or not isinstance(path, AlongParameter):
            return None
        return restart.resolved(path.beyond(until), restart.effort)
