"""A branch point of a curve, and the first points of the branch (theory §6.2)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice

import numpy as np

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.newton import correct
from hbm.curves.tracer import Tracer
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import AlongFrequency
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse

OFFSETS = (0.01, 0.03, 0.1)
"""distances from a branch point that are tried, over the size of the motion"""
SPANNED = 1e-4
"""size of a motion along the curve, over the largest, below which it has none"""
SINGULAR = 10.0
"""times the least singular value of the whole Jacobian that one aside may have"""


@dataclass(frozen=True, slots=True)
class BranchPoint:
    """Where a branch begins, and the direction in which it does."""

    tracer: Tracer
    """of the branch"""
    point: Array
    away: Array
    """unit direction of the branch"""
    aside: Array
    """unit vectors, as columns, of what no motion along the curve has"""

    @classmethod
    def of(
        cls,
        response: PeriodicResponse,
        known: Sequence[PeriodicResponse],
        tracer: Tracer,
        path: AlongFrequency,
    ) -> BranchPoint:
        """Return that of one response among those ``known`` along the curve."""
        point = tracer.guess(response, path.problem.selection)
        aside = _aside(tracer, path, known)
        away = _direction(path, point, tracer.system.fourier, aside)
        return cls(tracer, point, away, aside)

    def beside(self) -> Array | None:
        """Return a point of the branch, corrected across it; None if it is lost."""
        size = float(np.linalg.norm(self.point[self.tracer.path.rank : -1]))
        for offset in OFFSETS:
            guess = self.point + offset * size * self.away
            found = correct(
                self.tracer.system,
                guess,
                self.away,
                tolerance=self.tracer.control.tolerance,
            )
            if found.outcome is Outcome.CONVERGED:
                return found.point
        return None

    def outward(self, begun: Array) -> Iterator[Correction]:
        """Yield the corrections from ``begun`` beside the branch point on.

        If the first step lands on the mirror image of the branch, as those of more
        harmonics may, it goes on there.
        """
        pieces = self.tracer.pieces
        corrections = pieces.from_point(begun, self.away)
        first = next(corrections)
        try:
            both = [first, *islice(corrections, 1)]
        except ContinuationError:
            yield first
            raise
        before, after = (self._off(each) for each in (first, both[-1]))
        if before @ after < 0.0:
            along = both[-1].along
            outward = float((along @ self.aside) @ after) > 0.0
            yield from pieces.from_point(both[-1].point, along if outward else -along)
            return
        yield from both
        yield from corrections

    def parted(
        self, corrections: Iterable[Correction], back: list[float]
    ) -> Iterator[Correction]:
        """Yield what is aside of the point; put into ``back`` where it comes back.

        It does where what is ``aside`` of all motions along the curve vanishes, or
        changes its sign.
        """
        before: Array = np.zeros(self.aside.shape[1])
        least = 0.0
        for each in corrections:
            after = self._off(each)
            least = least or 0.5 * float(np.linalg.norm(after))
            near, passed = np.linalg.norm(after) <= least, before @ after < 0.0
            if near or passed:
                back.append(float(each.point[-1]))
            if not near:
                yield each
            if back:
                return
            before = after

    def _off(self, correction: Correction) -> Array:
        """Return what a point has that no motion along the curve has."""
        return (correction.point - self.point) @ self.aside


def _aside(
    tracer: Tracer, path: AlongFrequency, known: Sequence[PeriodicResponse]
) -> Array:
    """Return unit vectors, as columns, of what no motion along the curve has.

    A symmetry may keep coefficients still, or have coordinates move alike. Without
    one they are all that there is.
    """
    places = np.flatnonzero(path.mask(tracer.system.fourier.harmonics))
    selection, rest = path.problem.selection, path.problem.rest
    motions = np.array([tracer.guess(each, selection) for each in known])
    motions[:, : path.rank] -= rest
    _, sizes, rows = np.linalg.svd(motions[:, places])
    spanned = int((sizes > SPANNED * sizes[0]).sum())
    across = rows[spanned:] if spanned < len(places) else rows
    aside = np.zeros((motions.shape[1], len(across)))
    aside[places] = across.T
    return aside


def _direction(
    path: AlongFrequency, point: Array, fourier: FourierBasis, aside: Array
) -> Array:
    """Return the unit direction ``aside`` that the Jacobian maps nearest to zero.

    Or that of all, where the one aside is not mapped near to it.
    """
    _, linearised = path.balance(fourier)(point)
    places = np.flatnonzero(path.mask(fourier.harmonics))
    found = []
    for among in (aside[places], np.eye(len(places))):
        slope = among.T @ linearised.jacobian @ among
        _, sizes, rows = np.linalg.svd(slope)
        found.append((float(sizes[-1]), among @ rows[-1]))
    (least, best), (all_, other) = found
    direction = np.zeros_like(point)
    direction[places] = best if least < SINGULAR * all_ else other
    return direction
