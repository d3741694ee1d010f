"""A trace that goes round corners, where a curve may turn back sharply (§6.2)."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass, replace

from hbm.continuation.corner import round_corner
from hbm.continuation.correction import Correction
from hbm.continuation.tracing import Tracing
from hbm.continuation.trail import Trail
from hbm.errors import ContinuationError, ReturnedError
from microslip_mechanics.arrays import Array

REMEMBERED = 60
"""points behind the last one, by which the way to a corner is known"""
CORNERS = 30
"""round which a curve may turn before it is given up"""
AHEAD = (0.0, 1e-3, 1e-2)
"""arc lengths beyond the point behind a corner at which the curve is taken up again"""


@dataclass(frozen=True, slots=True)
class Cornered:
    """The corrections along a curve, in order; corners are gone round."""

    tracing: Tracing
    start: Array
    """first guess, shape (n + 1,)"""
    direction: Array | None = None
    """where to go first, shape (n + 1,); towards the end if left out"""

    def __iter__(self) -> Iterator[Correction]:
        """Yield corrections; the first behind a corner is joined to the one before.

        Raises
        ------
        ContinuationError
            If the curve does not go on, and there is no corner.
        """
        guess: Array = self.start
        direction, taken_up, turns = self.direction, False, False
        way: deque[Correction] = deque(maxlen=REMEMBERED)
        trail = Trail(self.tracing.system, self.tracing.control)
        for corner in range(CORNERS + 1):
            try:
                for correction in self._taken_up(guess, direction, trail, taken_up):
                    joined = correction.joined or taken_up
                    way.append(replace(correction, joined=joined, turns=turns))
                    yield way[-1]
                    turns = False
            except ReturnedError:
                raise
            except ContinuationError:
                if not way or corner == CORNERS:
                    raise
                turned = round_corner(
                    self.tracing.system,
                    way,
                    self.tracing.metric,
                    self.tracing.control.tolerance,
                    trail.has_been_at,
                )
                if turned is None:
                    raise
                guess, direction, turns = turned
                taken_up = True
            else:
                return

    def _taken_up(
        self, guess: Array, direction: Array | None, trail: Trail, behind: bool
    ) -> Iterator[Correction]:
        """Yield the corrections from a guess in a direction, or ``behind`` a corner.

        With more harmonics the corner may lie a little further on: what is before it
        has a tangent along which the parameter goes back, and is passed over.
        """
        if direction is None or not behind:
            yield from self.tracing.points(guess, direction, trail)
            return
        for ahead in AHEAD:
            traced = self.tracing.points(guess + ahead * direction, direction, trail)
            first = next(traced)
            if first.along[-1] * direction[-1] >= 0.0:
                break
        yield first
        yield from traced
