"""A trace that begins by homotopy, and begins again, where Newton resists (§6.2)."""

from __future__ import annotations

import contextlib
from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass, replace

from hbm.continuation.correction import Correction
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.continuation.tracing import Tracing
from hbm.curves.grown import Resolved
from hbm.curves.incoming import Incoming
from hbm.curves.piece import Piece
from hbm.curves.restart import FIRST, LEAPS, Restart
from hbm.errors import PLACE, ContinuationError
from hbm.paths.path import Path
from hbm.paths.path_metric import path_metric
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

POINTS = 1000
"""of a curve from a point in its midst, which may never end, before it is given up"""


@dataclass(frozen=True, slots=True)
class Pieces:
    """The corrections along a curve from ``start`` to ``end``, in order.

    A curve that folds back and returns to ``start``, that stops, or that does not
    begin, is followed from ``end`` as well; in the last case if Newton's iteration
    from rest begins it there. Where it has left the range, what comes in from beyond is
    followed too. If all that returns, what lies between is sought.
    """

    path: Path
    system: AdaptiveBalance
    start: float
    """parameter at which the curve begins"""
    end: float
    control: StepControl
    effort: Effort
    resolved: Resolved | None = None
    """what makes the system of another path; none if left out"""

    def __iter__(self) -> Iterator[Correction]:
        """Yield corrections; the first of a new piece has no tangent before it."""
        incoming = Incoming(self.restart, self.start, self.end)
        turns = yield from self._traced(incoming)
        passes = yield from self._beyond(incoming)
        if turns is not None and not passes:
            yield from self._between(turns, incoming)
            yield from self._beyond(incoming)

    def from_point(self, guess: Array, direction: Array) -> Iterator[Correction]:
        """Yield corrections from a point in a direction, until the range ends.

        Or until the curve closes.
        """
        control = replace(self.control, most_points=POINTS)
        yield from Tracing(
            self.system, self.end, self.start, self.metric, control, self.system
        ).points(guess, direction)

    @property
    def restart(self) -> Restart:
        """Where a new piece begins."""
        return Restart(
            self.path,
            self.system,
            self.control,
            self.effort,
            self.metric,
            self.resolved,
        )

    def metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc."""
        return path_metric(self.path, point)

    def _piece(
        self, guess: Array, heading: float, leaps: Sequence[float] = ()
    ) -> Iterator[Correction]:
        """Return the corrections from a first guess, past what resists."""
        piece = Piece(self.restart, (self.start, self.end))
        return piece.from_guess(guess, heading, iter(leaps))

    def _traced(self, incoming: Incoming) -> Generator[Correction, None, float | None]:
        """Yield corrections from one end or both; note where they leave the range.

        Return the share of the range up to where the first returns, if both do so
        before they meet.
        """
        there: list[float] = []
        stopped: ContinuationError | None = None
        begun = self._piece(self.restart.still(self.start), self.end, FIRST)
        try:
            yield from self._noted(begun, there, incoming)
        except ContinuationError as error:
            stopped = error
        if stopped is None and _arrived(there, 1.0):
            if there:
                incoming.ask(self.restart.still(self.end))
            return None
        back: list[float] = []
        self.system.restart(self.system.fourier.harmonics)
        again = FIRST if there else ()
        begun = self._piece(self.restart.still(self.end), self.start, again)
        try:
            yield from self._noted(begun, back, incoming)
        except ContinuationError as error:
            raise stopped or error from None
        if _arrived(back, 0.0):
            return None
        if stopped is not None:
            raise stopped
        return max(there) if max(there) < min(back) else None

    def _noted(
        self,
        corrections: Iterator[Correction],
        shares: list[float],
        incoming: Incoming,
    ) -> Iterator[Correction]:
        """Yield corrections, and note the share of the range before each of them.

        And where they leave the range: behind the last of them, and before the first.
        """
        first: Correction | None = None
        for last in corrections:
            first = first or last
            shares.append(
                (float(last.point[-1]) - self.start) / (self.end - self.start)
            )
            yield last
        if first is not None:
            incoming.leave(last.point)
            incoming.leave(first.point)

    def _beyond(self, incoming: Incoming) -> Generator[Correction, None, bool]:
        """Yield what comes in from beyond the range; return whether some passes it.

        That is more than was asked: where it cannot go on, it ends.
        """
        passes = False
        for point, heading in incoming:
            with contextlib.suppress(ContinuationError):
                for last in self._piece(point, heading):
                    yield last
                incoming.leave(last.point)
                passes = passes or last.point[-1] == heading
        return passes

    def _between(self, reached: float, incoming: Incoming) -> Iterator[Correction]:
        """Yield corrections from beyond where curves from both ends turn back.

        ``reached`` is the share of the range up to where the first does.
        """
        where, shares = self.start + reached * (self.end - self.start), [reached]
        guess = self.restart.point(where, self.end, iter(LEAPS))
        if guess is not None:
            pieces = self._piece(guess, self.end, LEAPS)
            yield from self._noted(pieces, shares, incoming)
        if shares[-1] != 1.0:
            raise ContinuationError(
                f"the curve turns back at {PLACE}, and that from the other end of the "
                "range before it comes there: what lies between was not found; a "
                "smaller tolerance, or more harmonics, may lead round the corner",
                where,
            )


def _arrived(shares: list[float], end: float) -> bool:
    """Return whether a trace has come to an end of the range, or had nothing to trace.

    ``shares`` are those of the range that lie before each of its points.
    """
    return not shares or shares[-1] == end
