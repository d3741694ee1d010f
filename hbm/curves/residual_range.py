"""The least and the greatest amplitudes that residual tractions allow (theory §6.5).

A slider that never slips may carry any mean traction within its limit: what came before
decides. Where normal loads follow that, amplitudes do. Their extremes are sought by
successive linear programmes: each gives tractions with which an amplitude is farther,
to first order; the response with these is solved for, and what it allows is looked at
again. Every extreme is a response. Where all stick, one in which a slider slips is
begun with; where tractions may break a symmetry, so that amplitudes are at an extreme
already, those in which points are relieved.
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.linearised import SingularError
from hbm.curves.extreme import extreme
from hbm.curves.reached import GAIN, PARTS, Reached
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array, largest

FOURIER = FourierBasis(15, 256)
"""resolution of the responses"""
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
        self._resolution, self._kept = resolution.in_all()
        aside = self._resolution.mask(FOURIER.harmonics)
        aside[:, self._kept] &= ~resolution.mask(FOURIER.harmonics)
        self._aside = np.flatnonzero(aside)
        """coefficients that a symmetry keeps still along the curve"""
        self._rows, self._tolerance = rows, tolerance
        self.last: Extremes = {}
        """of the point before, where they are apart from it"""

    def begin(self) -> None:
        """Forget the point before: the next one does not follow it."""
        self.last.clear()

    def at(self, point: Array) -> Array:
        """Return by how much amplitudes may change, shape (2, probes).

        As shares of their :func:`~microslip_mechanics.results.response.measure`; the
        first row is that of lower ones. ``point`` is one of the curve, with any number
        of harmonics. NaN if there is no response to begin with.
        """
        balance, guess = self._begun(point)
        found = np.zeros((2, len(self._rows)))
        last, self.last = self.last, {}
        bent = balance.problem.bent
        here = Reached.by(balance, bent, guess, self._rows, self._tolerance)
        if here is None:
            return np.full_like(found, np.nan)
        others = self._others(here)
        for probe in self._open(here, last, others):
            for side, sign in enumerate(SIDES):
                begun = [here, *others, *_again(last.get((probe, sign)), here)]
                farthest = extreme(begun, probe, sign)
                if farthest is not here:
                    self.last[probe, sign] = farthest
                    gained = farthest.amplitude[probe] - here.amplitude[probe]
                    found[side, probe] = gained / here.measure[probe]
        return found

    def _begun(self, point: Array) -> tuple[HarmonicBalance, Array]:
        """Return the system in all coordinates, and a point of the curve for it.

        With as many harmonics as are solved for.
        """
        wide = np.zeros(FOURIER.coefficients * self._resolution.rank + 1)
        wide[-1] = point[-1]
        balance, there = self._resolution.at(FOURIER).at_frequency(wide)
        table = np.zeros((FOURIER.coefficients, self._resolution.rank))
        table[0] = balance.problem.rest
        if self._kept.size:  # without drive nothing is solved for
            known = point[:-1].reshape(-1, self._kept.size)[: len(table)]
            table[: len(known), self._kept] = known
        return balance, balance.point(table, float(there[-1]))

    def _open(self, here: Reached, last: Extremes, others: list[Reached]) -> set[int]:
        """Return the probes whose amplitudes may change."""
        try:
            found = {*here.leeway.opens(GAIN), *(probe for probe, _ in last)}
        except SingularError:
            return set()
        ways = [(probe, side) for probe in range(len(self._rows)) for side in SIDES]
        beyond = (way[0] for way in ways for one in others if one.beyond(here, *way))
        return found.union(beyond)

    def _others(self, here: Reached) -> list[Reached]:
        """Return responses that are begun with besides: those that are found.

        One in which what sticks here slips, and where a symmetry may be broken those in
        which points are relieved.
        """
        try:
            leeway = here.leeway
        except SingularError:
            return []
        loosening = leeway.loosening()
        found = [here.moved(loosening)] if loosening.any() else []
        for change in leeway.relieving() if self._aside.size else ():
            moved = leeway.changes[:-1] @ change
            if largest(moved[self._aside]) > GAIN * largest(moved):
                found += [here.changed(part * change) for part in PARTS]
        return [each for each in found if each is not None]


def _again(last: Reached | None, here: Reached) -> list[Reached]:
    """Return the response that has the tractions of one of the point before, if any."""
    if last is None:
        return []
    coefficients, _ = last.balance.split(last.point)
    guess = here.balance.point(coefficients, float(here.point[-1]))
    made = here.bent_by(last.balance.problem.bent, guess)
    return [] if made is None else [made]
