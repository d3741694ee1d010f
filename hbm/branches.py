"""Branches that begin where a Floquet multiplier passes +1 beside a fold (theory §6).

They break a symmetry of the curve that they leave, so that all coordinates and orders
are solved for. At the branch point the Jacobian has a direction that it maps to zero; a
point a little along it is corrected in the plane across it, and followed from there.
"""

from __future__ import annotations

from collections.abc import Generator, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hbm.crossings import BRANCH
from hbm.fourier import FourierBasis
from hbm.newton import Correction, Outcome, correct
from hbm.options import CurveOptions
from hbm.path import AlongFrequency
from hbm.tracer import Tracer
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse

OFFSETS = (0.01, 0.03, 0.1)
"""distances from a branch point that are tried, over the size of the motion"""
NEAR = 0.05
"""distance of a multiplier from +1 up to which a located branch point is believed"""
FEWEST, FINEST = 15, 63
"""harmonics with which a branch is sought"""
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
            low, high = yield from self._from(place)
            for other, end in enumerate(places):
                near = (1.0 - CLOSE) * low <= end.frequency <= (1.0 + CLOSE) * high
                if near and other != number and other not in reached:
                    reached.add(other)
                    yield replace(end, event="")

    def _from(
        self, response: PeriodicResponse
    ) -> Generator[PeriodicResponse, None, tuple[float, float]]:
        """Yield the responses on the branch at one point, until it comes back.

        Returns the frequencies between which it does; none if it does not.
        """
        tracer = Tracer(self.problem, self.path, self.options)
        tracer.system.restart(min(max(response.harmonics, FEWEST), FINEST))
        point = tracer.guess(response, self.path.problem.selection)
        away = self._direction(point, tracer.system.fourier)
        begun = _beside(tracer, point, away)
        if begun is None:
            return NOWHERE
        back: list[float] = []
        corrections = tracer.pieces.from_point(begun, away)
        parted = _parted(corrections, point, begun, away != 0.0, back)
        last: list[float] = []
        for each in tracer.curve.followed(parted, tracer.pieces.metric):
            if not last:
                yield replace(response, event="branch")
            if not each.event and not back:
                last.clear()  # it is about the last step that is asked
            last.append(each.frequency)
            yield each
        return (min(last + back), max(last + back)) if back and last else NOWHERE

    def _direction(self, point: Array, fourier: FourierBasis) -> Array:
        """Return the unit direction that the Jacobian maps nearest to zero.

        Among what a symmetry keeps still on the curve, if there is a symmetry.
        """
        _, linearised = self.path.balance(fourier)(point)
        places = np.flatnonzero(self.path.mask(fourier.harmonics))
        moved = point[places]
        moved[: self.path.rank] -= self.path.problem.rest
        still = np.abs(moved) <= 1e-9 * np.abs(moved).max()
        chosen = still if still.any() else ~still
        _, _, rows = np.linalg.svd(linearised.jacobian[np.ix_(chosen, chosen)])
        direction = np.zeros_like(point)
        direction[places[chosen]] = rows[-1]
        return direction


def _branches(response: PeriodicResponse) -> bool:
    """Return whether a multiplier is +1 there, as it must be to the error of both."""
    nearest = np.abs(response.multipliers - 1.0).min(initial=np.inf)
    return response.event == BRANCH and bool(nearest < NEAR)


def _parted(
    corrections: Iterable[Correction],
    point: Array,
    begun: Array,
    still: NDArray[np.bool_],
    back: list[float],
) -> Iterator[Correction]:
    """Yield what is aside of a branch point; put into ``back`` where it comes back.

    It does where what the symmetry keeps ``still`` vanishes, or changes its sign.
    """
    before = (begun - point)[still]
    least = 0.5 * float(np.linalg.norm(before))
    for each in corrections:
        after = (each.point - point)[still]
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
