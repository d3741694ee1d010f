"""A trace that leaps over what resists: small jumps of a sampled residual (§6.8).

Where a contact opens or turns over at a sample, the residual may jump by a little, and
the curve has a gap too small to matter. A leap along the tangent passes it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from hbm.continuation.arc import distance, plane_across
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.newton import correct
from hbm.continuation.tracing import Tracing
from hbm.errors import PLACE, ContinuationError
from microslip_mechanics.arrays import Array

LEAPS = (1e-3, 1e-2, 3e-2, 0.1, 0.3)
"""arc lengths, tried in turn"""
MOST = 20
"""leaps that a curve may take before it is given up"""
SMOOTHER = (
    "more harmonics or, where friction has one, a larger threshold velocity make it "
    "smoother"
)

BACK = -0.9
"""cosine between two steps, below which the second leads back along the first"""


@dataclass(frozen=True, slots=True)
class Leaping:
    """The corrections along a curve, in order; small gaps are passed."""

    tracing: Tracing
    start: Array
    """first guess, shape (n + 1,)"""

    def __iter__(self) -> Iterator[Correction]:
        """Yield corrections; the first after a leap is not joined to the one before.

        Raises
        ------
        ContinuationError
            If a leap does not arrive, or if there are too many.
        """
        guess: Array = self.start
        direction: Array | None = None
        kept: list[Correction] = []
        for leap in range(MOST + 1):
            try:
                for correction in self.tracing.points(guess, direction):
                    if len(kept) > 1 and self._returns(kept, correction):
                        break
                    kept = [*kept[-1:], correction]
                    yield correction
                else:
                    return
            except ContinuationError:
                if not kept or leap == MOST:
                    raise
            guess, direction = self._leapt(kept)
        raise ContinuationError(
            f"the curve has {MOST} gaps up to {PLACE}: {SMOOTHER}",
            float(guess[-1]),
        )

    def _returns(self, kept: list[Correction], new: Correction) -> bool:
        """Return whether a point lies back on the way that led to the last one."""
        first, last = (each.point for each in kept)
        scale = self.tracing.metric(last)
        before, after = (last - first) / scale, (new.point - last) / scale
        size = float(np.linalg.norm(before) * np.linalg.norm(after))
        return float(before @ after) < BACK * size

    def _leapt(self, kept: list[Correction]) -> tuple[Array, Array]:
        """Return a point of the curve past a gap, and where the curve goes on."""
        last = kept[-1]
        scale, along = self.tracing.metric(last.point), last.along
        if (
            len(kept) > 1
            and float(along @ ((last.point - kept[0].point) / scale**2)) < 0
        ):
            along = -along
        normal = plane_across(along, scale)
        for leap in LEAPS:
            predicted = last.point + leap * along
            found = correct(
                self.tracing.system,
                predicted,
                normal,
                tolerance=self.tracing.control.tolerance,
            )
            near = distance(found.point, predicted, scale) <= leap
            if near and found.outcome is Outcome.CONVERGED:
                return found.point, along
        raise ContinuationError(
            f"the curve does not go on at {PLACE}, not even past it; {SMOOTHER}",
            float(last.point[-1]),
        )
