"""Branches that begin where a Floquet multiplier passes +1 beside a fold (theory §6).

They break a symmetry of the curve that they leave, so that all coordinates and orders
are solved for. At the branch point the Jacobian has a direction that it maps to zero; a
point a little along it is corrected in the plane across it, and followed from there.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from hbm.fourier import FourierBasis
from hbm.newton import Outcome, SingularError, correct
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
FINEST = 63
"""harmonics with which a branch is sought, at the most"""


@dataclass(frozen=True, slots=True)
class Branching:
    """Where branches of one problem begin."""

    problem: Problem
    path: AlongFrequency
    """in all coordinates and orders"""
    options: CurveOptions

    def curves(self, known: Sequence[PeriodicResponse]) -> Iterator[PeriodicResponse]:
        """Yield the responses on branches, the first of each marked so.

        Parameters
        ----------
        known
            Responses along a curve; those located as branch points are looked at.

        Raises
        ------
        ContinuationError
            If a branch cannot be followed.
        """
        passed: list[float] = []
        for response in known:
            if not _branches(response) or any(
                _returns(response.frequency, each) for each in passed
            ):
                continue
            tracer = Tracer(self.problem, self.path, self.options)
            begun = self._begun(tracer, response)
            if begun is None:
                continue
            corrections = tracer.pieces.from_point(*begun)
            metric = tracer.pieces.metric
            for each in tracer.curve.followed(corrections, metric, "branch"):
                yield each
                if each.event == "branch point":
                    passed.append(each.frequency)

    def _begun(
        self, tracer: Tracer, response: PeriodicResponse
    ) -> tuple[Array, Array] | None:
        """Return a point on the branch, and the direction that leads there."""
        tracer.system.restart(min(response.harmonics, FINEST))
        point = tracer.guess(response, self.path.problem.selection)
        away = self._direction(point, tracer.system.fourier)
        size = float(np.linalg.norm(point[self.path.rank : -1]))
        for offset in OFFSETS:
            try:
                found = correct(
                    tracer.system,
                    point + offset * size * away,
                    away,
                    tolerance=tracer.control.tolerance,
                )
            except SingularError:
                continue
            if found.outcome is Outcome.CONVERGED:
                return found.point, found.point - point
        return None

    def _direction(self, point: Array, fourier: FourierBasis) -> Array:
        """Return the unit direction that the Jacobian maps nearest to zero."""
        balance = self.path.balance(fourier)
        _, linearised = balance(point)
        _, _, rows = np.linalg.svd(linearised.jacobian)
        direction = np.zeros_like(point)
        places = np.flatnonzero(self.path.mask(fourier.harmonics))
        direction[places] = rows[-1]
        return direction


def _branches(response: PeriodicResponse) -> bool:
    """Return whether a multiplier is +1 there, as it must be to the error of both."""
    nearest = np.abs(response.multipliers - 1.0).min(initial=np.inf)
    return response.event == "branch point" and bool(nearest < NEAR)


def _returns(frequency: float, passed: float) -> bool:
    """Return whether a followed branch ended at this branch point."""
    return abs(frequency - passed) <= 1e-4 * passed
