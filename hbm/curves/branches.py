"""Branches that begin where a Floquet multiplier passes +1 beside a fold (theory §6.2).

They break a symmetry of the curve that they leave, so that all coordinates and orders
are solved for. At the branch point the Jacobian has a direction that it maps to zero; a
point a little along it is corrected in the plane across it, and followed from there.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from hbm.curves.branch_point import BranchPoint
from hbm.curves.tracer import Tracer
from hbm.events.crossed import BRANCH
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

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
        tracer.system.raise_floor()  # at its foot errors of amplitudes ask for less
        place = BranchPoint.of(response, known, tracer, self.path)
        begun = place.beside()
        if begun is None:
            return NOWHERE
        back: list[float] = []
        parted = place.parted(place.outward(begun), back)
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


def _branches(response: PeriodicResponse) -> bool:
    """Return whether a multiplier is +1 there, as it must be to the error of both."""
    nearest = np.abs(response.multipliers - 1.0).min(initial=np.inf)
    return response.event == BRANCH and bool(nearest < NEAR)
