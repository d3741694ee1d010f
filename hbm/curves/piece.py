"""A piece of a curve, past what resists (theory §6.2)."""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from hbm.continuation.cornered import REMEMBERED, Cornered
from hbm.continuation.correction import Correction
from hbm.continuation.tracing import Tracing
from hbm.curves.bounded import bounded
from hbm.curves.restart import Beginning, Restart
from hbm.errors import (
    ContinuationError,
    RetracedError,
    ReturnedError,
    UnboundedError,
)
from hbm.paths.path import AlongFrequency
from microslip_mechanics.arrays import Array

RESTARTS = 12
"""that a piece may take before it is given up"""


@dataclass(frozen=True, slots=True)
class Piece:
    """The corrections from a first guess to an end of the range."""

    restart: Restart
    """where it begins anew"""
    ends: tuple[float, float]
    """of the range"""

    def from_guess(
        self, guess: Array, heading: float, leaps: Iterator[float]
    ) -> Iterator[Correction]:
        """Yield corrections from a first guess towards the end ``heading``.

        ``leaps`` are those by which a first point is sought if there is none.

        Raises
        ------
        ContinuationError
            If it does not begin, or go on from anywhere.
        """
        begun = Beginning(guess, None, self.restart.control)
        for attempt in range(RESTARTS + 1):
            way: deque[Correction] = deque(maxlen=REMEMBERED)
            try:
                for correction in self._cornered(begun, heading):
                    if not way:
                        correction = replace(correction, replaces=begun.replaces)
                    way.append(correction)
                    yield correction
            except UnboundedError:
                raise
            except ContinuationError as error:
                heading = self._onwards(way[-1] if way else None, heading)
                leaps, again = self._again(error, way, begun, heading, leaps)
                if again is None or attempt == RESTARTS:
                    raise
                begun = again
            else:
                return

    def _again(
        self,
        error: ContinuationError,
        way: Sequence[Correction],
        begun: Beginning,
        heading: float,
        leaps: Iterator[float],
    ) -> tuple[Iterator[float], Beginning | None]:
        """Return the leaps that are left to try, and a new beginning, if there is one.

        It lies behind what resists if more harmonics lead no further, as where a curve
        goes round, or from where it has turned to go back on itself.
        """
        reached, known = float(begun.guess[-1]), list(way)
        if isinstance(error, ReturnedError) and error.parameter is not None:
            reached, known = error.parameter, _until(error.parameter, way)
        elif known:
            reached = float(known[-1].point[-1])
        # what has come to another part of the curve is not led there again
        if isinstance(error, RetracedError) or not isinstance(error, ReturnedError):
            finer = self.restart.finer(known, begun.control)
            if finer is not None:
                gone_back = len(way) - len(known)
                return leaps, finer._replace(replaces=finer.replaces + gone_back)
        return self.restart.behind(reached, begun, heading, leaps)

    def _cornered(self, begun: Beginning, heading: float) -> Iterator[Correction]:
        """Yield corrections, round corners, while the curve is bounded."""
        path, system, (start, end) = self.restart.path, self.restart.system, self.ends
        tracing = Tracing(
            system,
            heading,
            start if heading == end else end,
            self.restart.metric,
            begun.control,
            system,
        )
        piece = Cornered(tracing, begun.guess, begun.direction)
        if isinstance(path, AlongFrequency):
            yield from bounded(piece, path.rank, path.vibration)
        else:
            yield from piece

    def _onwards(self, last: Correction | None, heading: float) -> float:
        """Return the end of the range to which the curve was going."""
        if last is None or last.along[-1] == 0.0:
            return heading
        onwards = math.copysign(1.0, last.along[-1])
        return max(self.ends, key=lambda each: onwards * each)


def _until(place: float, way: Sequence[Correction]) -> list[Correction]:
    """Return a way up to where its parameter was at a place; none if it never was."""
    places = [float(each.point[-1]) for each in way]
    return list(way)[: places.index(place) + 1] if place in places else []
