"""The least and the greatest amplitudes that residual tractions allow (theory §6.5).

A slider that never slips may carry any mean traction within its limit: what came before
decides. Where normal loads follow that, amplitudes do. Their extremes are sought by
successive linear programmes: each gives tractions with which an amplitude is farther,
to first order; the response with these is solved for, and what it allows is looked at
again. Every extreme is a response. Where all stick, one in which a slider slips is
begun with.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeAlias

import numpy as np

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import upright
from hbm.continuation.correction import Outcome
from hbm.continuation.linearised import SingularError
from hbm.continuation.newton import correct
from hbm.curves.reached import GAIN, Reached
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array

FOURIER = FourierBasis(15, 256)
"""resolution of the responses"""
ROUNDS = 8
"""linear programmes for an extreme, at the most"""
ITERATIONS = 15
"""of Newton, for a response"""
PARTS = (1.0, 0.5, 0.25, 0.1)
"""of a change of tractions that are tried"""
BACK = (0.75, 0.5, 0.25, 0.0)
"""shares of residual tractions on the way back from an extreme"""
SAME = 1e-2
"""relative difference of amplitudes up to which that leads to where it began"""
SIDES = (-1.0, 1.0)


Extremes: TypeAlias = dict[tuple[int, float], Reached]
"""of a point, by probe and side"""


class ResidualRange:
    """Finds the extremes at one point of a curve after another.

    Those of the point before are begun with, too: they may lie where sliders slip that
    stick along the curve.
    """

    def __init__(
        self, resolution: PathResolution, rows: Array, tolerance: float
    ) -> None:
        """Take the curve's system, and the probes, shape ``(probes, dofs)``.

        ``tolerance`` is that of the largest residual [N].
        """
        self._resolution, self._rows = resolution, rows
        self._tolerance = tolerance
        self.last: Extremes = {}
        """of the point before, where they are apart from it"""

    def begin(self) -> None:
        """Forget the point before: the next one does not follow it."""
        self.last.clear()

    def at(self, point: Array) -> Array:
        """Return by how much amplitudes may change, relative, shape (2, probes).

        The first row is that of lower ones. ``point`` is one of the curve, with any
        number of harmonics. NaN if there is no response to begin with.
        """
        balance, guess = self._resolution.at(FOURIER).at_frequency(self._cut(point))
        found = np.zeros((2, len(self._rows)))
        last, self.last = self.last, {}
        here = self._solved(balance, balance.problem.bent, guess)
        if here is None:
            return np.full_like(found, np.nan)
        loosened = self._loosened(here)
        for probe in self._open(here, last, loosened):
            for side, sign in enumerate(SIDES):
                known = last.get((probe, sign))
                farthest = self._extreme(here, known, loosened, probe, sign)
                change = farthest.amplitude[probe] / here.amplitude[probe] - 1.0
                if abs(change) > GAIN and self._returns(farthest, here):
                    self.last[probe, sign] = farthest
                    found[side, probe] = change
        return found

    def _returns(self, farthest: Reached, here: Reached) -> bool:
        """Return whether an extreme goes back to the curve as its tractions do.

        Else it belongs to another curve: there are several responses beside a fold.
        """
        bent, reached = farthest.balance.problem.bent, farthest
        if bent is None:
            return False
        for share in BACK:
            held: Array = share * bent
            solved = self._solved(here.balance, held, reached.point)
            if solved is None:
                return False
            reached = solved
        away = abs(reached.amplitude - here.amplitude).max()
        return bool(away <= SAME * here.amplitude.max())

    def _cut(self, point: Array) -> Array:
        """Return a point with as many harmonics as are solved for here."""
        cut = np.zeros(FOURIER.coefficients * self._resolution.rank + 1)
        count = min(cut.size, point.size) - 1
        cut[:count], cut[-1] = point[:count], point[-1]
        return cut

    def _open(
        self, here: Reached, last: Extremes, loosened: Reached | None
    ) -> set[int]:
        """Return the probes whose amplitudes may change."""
        try:
            found = {*here.leeway.opens(GAIN), *(probe for probe, _ in last)}
        except SingularError:
            return set()
        if loosened is None:
            return found
        ways = [(probe, side) for probe in range(len(self._rows)) for side in SIDES]
        return found.union(way[0] for way in ways if loosened.beyond(here, *way))

    def _loosened(self, here: Reached) -> Reached | None:
        """Return a response in which what sticks here slips, if one is found."""
        try:
            leeway = here.leeway
        except SingularError:
            return None
        change = leeway.loosening()
        for part in PARTS if change.any() else ():
            guess = here.point + leeway.changes @ (part * change)
            made = self._solved(here.balance, leeway.stuck.bent(part * change), guess)
            if made is not None:
                return made
        return None

    def _extreme(
        self,
        here: Reached,
        last: Reached | None,
        loosened: Reached | None,
        probe: int,
        sign: float,
    ) -> Reached:
        """Return the farthest response, sought from that before, or else from here.

        Or from where a slider slips that sticks here, if that is farther.
        """
        if last is not None:
            coefficients, _ = last.balance.split(last.point)
            guess = here.balance.point(coefficients, float(here.point[-1]))
            begun = self._solved(here.balance, last.balance.problem.bent, guess)
            if begun is not None and begun.beyond(here, probe, sign):
                return self._farthest(begun, probe, sign)
        if loosened is not None and loosened.beyond(here, probe, sign):
            return self._farthest(loosened, probe, sign)
        return self._farthest(here, probe, sign)

    def _farthest(self, begun: Reached, probe: int, sign: float) -> Reached:
        """Return the response that is farthest of those found beyond one."""
        reached = begun
        for _ in range(ROUNDS):
            made = self._farther(reached, probe, sign)
            if made is None:
                break
            reached = made
        return reached

    def _farther(self, reached: Reached, probe: int, sign: float) -> Reached | None:
        """Return a response that is farther, if one is found."""
        try:
            leeway = reached.leeway
        except SingularError:
            return None
        change = leeway.farthest(probe, sign)
        worth = abs(leeway.slopes[probe] @ change) > GAIN * reached.amplitude[probe]
        for part in PARTS if worth else ():
            bent = leeway.stuck.bent(part * change)
            guess = reached.point + leeway.changes @ (part * change)
            made = self._solved(reached.balance, bent, guess)
            if made is not None and made.beyond(reached, probe, sign):
                return made
        return None

    def _solved(
        self, like: HarmonicBalance, bent: Array | None, guess: Array
    ) -> Reached | None:
        """Return the response with sliders that are bent so, if it is found."""
        balance = like.with_problem(replace(like.problem, bent=bent))
        made = correct(
            balance,
            guess,
            upright(guess),
            tolerance=self._tolerance,
            max_iterations=ITERATIONS,
        )
        if made.outcome is not Outcome.CONVERGED:
            return None
        return Reached(balance, made.point, self._rows)
