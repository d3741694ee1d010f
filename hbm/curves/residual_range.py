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
from hbm.curves.reached import GAIN, PARTS, Reached
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array, largest

FOURIER = FourierBasis(15, 256)
"""resolution of the responses"""
ROUNDS = 8
"""linear programmes for an extreme, at the most"""
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
        """Return by how much amplitudes may change, relative, shape (2, probes).

        The first row is that of lower ones. ``point`` is one of the curve, with any
        number of harmonics. NaN if there is no response to begin with.
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
                farthest = _extreme(begun, probe, sign)
                if farthest is not here:
                    self.last[probe, sign] = farthest
                    found[side, probe] = farthest.amplitude[probe]
                    found[side, probe] /= here.amplitude[probe]
                    found[side, probe] -= 1.0
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


def _extreme(begun: list[Reached], probe: int, sign: float) -> Reached:
    """Return the farthest response that leads back to the first of those begun with.

    It is sought from the farthest of them, or else from the first, which is returned if
    none is farther.
    """
    here = begun[0]
    first = max(begun, key=lambda each: sign * each.amplitude[probe])
    for start in (first, here) if first is not here else (here,):
        farthest = _farthest(start, probe, sign)
        if farthest.beyond(here, probe, sign) and _returns(farthest, here):
            return farthest
    return here


def _farthest(begun: Reached, probe: int, sign: float) -> Reached:
    """Return the response that is farthest of those found beyond one."""
    reached = begun
    for _ in range(ROUNDS):
        made = _farther(reached, probe, sign)
        if made is None:
            break
        reached = made
    return reached


def _farther(reached: Reached, probe: int, sign: float) -> Reached | None:
    """Return a response that is farther, if one is found."""
    try:
        leeway = reached.leeway
    except SingularError:
        return None
    change = leeway.farthest(probe, sign)
    here, slope = reached.amplitude[probe], leeway.slopes[probe] @ change
    made = None
    for part in PARTS if abs(slope) > GAIN * here else ():
        made = reached.changed(part * change)
        if made is not None and made.beyond(reached, probe, sign):
            return made
    if made is None:
        return None
    # the last part went too far: a parabola says where the extreme is
    bend = (made.amplitude[probe] - here - PARTS[-1] * slope) / PARTS[-1] ** 2
    if sign * bend >= 0.0:
        return None
    nearer = reached.changed(-0.5 * slope / bend * change)
    return nearer if nearer and nearer.beyond(reached, probe, sign) else None


def _returns(farthest: Reached, here: Reached) -> bool:
    """Return whether an extreme goes back to the curve as its tractions do.

    Else it belongs to another curve: there are several responses beside a fold.
    """
    bent, reached = farthest.balance.problem.bent, farthest
    if bent is None:
        return False
    for share in BACK:
        held: Array = share * bent
        solved = here.bent_by(held, reached.point)
        if solved is None:
            return False
        reached = solved
    away = abs(reached.amplitude - here.amplitude).max()
    return bool(away <= SAME * here.amplitude.max())
