"""Branches that begin where a Floquet multiplier passes +1 beside a fold (theory §6.2).

They break a symmetry of the curve that they leave, so that all coordinates and orders
are solved for. At the branch point the Jacobian has a direction that it maps to zero; a
point a little along it is corrected in the plane across it, and followed from there.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import islice

import numpy as np

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.newton import correct
from hbm.curves.pieces import Pieces
from hbm.curves.tracer import Tracer
from hbm.errors import ContinuationError
from hbm.events.crossed import BRANCH
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

OFFSETS = (0.01, 0.03, 0.1)
"""distances from a branch point that are tried, over the size of the motion"""
NEAR = 0.05
"""distance of a multiplier from +1 up to which a located branch point is believed"""
FEWEST, FINEST = 15, 63
"""harmonics with which a branch is sought"""
SPANNED = 1e-4
"""size of a motion along the curve, over the largest, below which it has none"""
SINGULAR = 10.0
"""times the least singular value of the whole Jacobian that one aside may have"""
CLOSE = 2e-3
"""relative difference of frequencies at which a branch ends on a branch point"""
NOWHERE = (np.inf, -np.inf)
"""an interval of frequencies in which there is nothing"""


@dataclass(frozen=True, slots=True)
class Branching:
    """Where branches of one problem begin."""

    problem: Problem
    path: AlongFrequency
    """in all coordinates and orders"""
    options: CurveOptions

    def curves(self, known: Sequence[PeriodicResponse]) -> Iterator[PeriodicResponse]:
        """Yield the responses on branches, the first of each marked so.

        A branch begins with its branch point, and ends with the one to which it
        returns.

        Parameters
        ----------
        known
            Responses along a curve; those located as branch points are looked at.

        Raises
        ------
        ContinuationError
            If a branch cannot be followed.
        """
        places = [each for each in known if _branches(each)]
        reached: set[int] = set()
        for number, place in enumerate(places):
            if number in reached:
                continue
            low, high = yield from self._from(place, known)
            for other, end in enumerate(places):
                near = (1.0 - CLOSE) * low <= end.frequency <= (1.0 + CLOSE) * high
                if near and other != number and other not in reached:
                    reached.add(other)
                    yield replace(end, event="")

    def _from(
        self, response: PeriodicResponse, known: Sequence[PeriodicResponse]
    ) -> Generator[PeriodicResponse, None, tuple[float, float]]:
        """Yield the responses on the branch at one point, until it comes back.

        Returns the frequencies between which it does; none if it does not.
        """
        tracer = Tracer(self.problem, self.path, self.options)
        tracer.system.restart(min(max(response.harmonics, FEWEST), FINEST))
        point = tracer.guess(response, self.path.problem.selection)
        aside = self._aside(tracer, known)
        away = self._direction(point, tracer.system.fourier, aside)
        begun = _beside(tracer, point, away)
        if begun is None:
            return NOWHERE
        back: list[float] = []
        corrections = _outward(tracer.pieces, point, begun, away, aside)
        parted = _parted(corrections, point, aside, back)
        last: list[float] = []
        for each in tracer.curve.followed(parted, tracer.pieces.metric):
            if not last:
                yield replace(response, event="branch")
            if not each.event and not back:
                last.clear()  # it is about the last step that is asked
            last.append(each.frequency)
            if not back or each.event not in ("", "fold"):
                yield each  # where it comes back it turns into its mirror image
        return (min(last + back), max(last + back)) if back and last else NOWHERE

    def _aside(self, tracer: Tracer, known: Sequence[PeriodicResponse]) -> Array:
        """Return unit vectors, as columns, of what no motion along the curve has.

        A symmetry may keep coefficients still, or have coordinates move alike. Without
        one they are all that there is.
        """
        places = np.flatnonzero(self.path.mask(tracer.system.fourier.harmonics))
        selection, rest = self.path.problem.selection, self.path.problem.rest
        motions = np.array([tracer.guess(each, selection) for each in known])
        motions[:, : self.path.rank] -= rest
        _, sizes, rows = np.linalg.svd(motions[:, places])
        spanned = int((sizes > SPANNED * sizes[0]).sum())
        across = rows[spanned:] if spanned < len(places) else rows
        aside = np.zeros((motions.shape[1], len(across)))
        aside[places] = across.T
        return aside

    def _direction(self, point: Array, fourier: FourierBasis, aside: Array) -> Array:
        """Return the unit direction ``aside`` that the Jacobian maps nearest to zero.

        Or that of all, where the one aside is not mapped near to it.
        """
        _, linearised = self.path.balance(fourier)(point)
        places = np.flatnonzero(self.path.mask(fourier.harmonics))
        found = []
        for among in (aside[places], np.eye(len(places))):
            slope = among.T @ linearised.jacobian @ among
            _, sizes, rows = np.linalg.svd(slope)
            found.append((float(sizes[-1]), among @ rows[-1]))
        (least, best), (all_, other) = found
        direction = np.zeros_like(point)
        direction[places] = best if least < SINGULAR * all_ else other
        return direction


def _branches(response: PeriodicResponse) -> bool:
    """Return whether a multiplier is +1 there, as it must be to the error of both."""
    nearest = np.abs(response.multipliers - 1.0).min(initial=np.inf)
    return response.event == BRANCH and bool(nearest < NEAR)


def _outward(
    pieces: Pieces, point: Array, begun: Array, away: Array, aside: Array
) -> Iterator[Correction]:
    """Yield the corrections from ``begun`` beside a branch point on.

    If the first step lands on the mirror image of the branch, as those of more
    harmonics may, it goes on there.
    """
    corrections = pieces.from_point(begun, away)
    first = next(corrections)
    try:
        both = [first, *islice(corrections, 1)]
    except ContinuationError:
        yield first
        raise
    before, after = ((each.point - point) @ aside for each in (first, both[-1]))
    if before @ after < 0.0:
        along = both[-1].along
        outward = float((along @ aside) @ after) > 0.0
        yield from pieces.from_point(both[-1].point, along if outward else -along)
        return
    yield from both
    yield from corrections


def _parted(
    corrections: Iterable[Correction],
    point: Array,
    aside: Array,
    back: list[float],
) -> Iterator[Correction]:
    """Yield what is aside of a branch point; put into ``back`` where it comes back.

    It does where what is ``aside`` of all motions along the curve vanishes, or changes
    its sign.
    """
    before, least = np.zeros(aside.shape[1]), 0.0
    for each in corrections:
        after = (each.point - point) @ aside
        least = least or 0.5 * float(np.linalg.norm(after))
        near, passed = np.linalg.norm(after) <= least, before @ after < 0.0
        if near or passed:
            back.append(float(each.point[-1]))
        if not near:
            yield each
        if back:
            return
        before = after


def _beside(tracer: Tracer, point: Array, away: Array) -> Array | None:
    """Return a point of the branch, corrected across its direction; None if lost."""
    size = float(np.linalg.norm(point[tracer.path.rank : -1]))
    for offset in OFFSETS:
        guess = point + offset * size * away
        found = correct(tracer.system, guess, away, tolerance=tracer.control.tolerance)
        if found.outcome is Outcome.CONVERGED:
            return found.point
    return None
