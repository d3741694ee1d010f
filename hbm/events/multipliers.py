"""Multipliers of truncated orbits; of finer ones where these may mislead (theory §6.4).

They may where contacts rattle, and where friction falls with the speed: there a few
harmonics may even balance where no orbit is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import linear_sum_assignment

from hbm.events.finer_orbits import FinerOrbits
from hbm.events.moving_multiplier import outside
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from hbm.stability.stability import SmallMotions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.points import GENERAL_KINETIC

RATTLING = 0.5
"""share of the contact points that lift off, from which more harmonics are tried"""
HARMONICS = 63
"""most that are taken for multipliers alone where friction falls"""
NEARLY = 0.75
"""share of the speed beyond which friction falls, from which more harmonics may slide
where few still stick"""
FINEST, UNKNOWNS = 1023, 2100
"""most that are taken where contacts rattle, and most unknowns beyond those above: a
stiff stop turns a small motion within a small part of a period"""
CHANGE = 1e-2
"""of the leading multipliers from one order to the next, from which they are known"""
DOUBT = 0.1
"""of that change: with more, where stability changes too, it is not known"""
ALIKE = 1e-3
"""of those from the order that the curve has to that of the reported orbit, up to which
the latter are known: a finer orbit need not be sought"""
LEADING = 3
"""how many of them are looked at"""


@dataclass(frozen=True, slots=True)
class Multipliers:
    """The Floquet multipliers at points of a path."""

    resolution: PathResolution
    motions: Callable[[float], SmallMotions] | None
    """parameter ↦ the structure for small motions, if stability is wanted"""
    orbits: FinerOrbits
    """of the path"""
    fixed: bool
    """whether the harmonics are given, not found"""

    def at(self, point: Array, fourier: FourierBasis) -> ComplexArray:
        """Return the multipliers of the orbit as it is; none if they are not wanted."""
        if self.motions is None:
            return np.empty(0, complex)
        balance, orbit = self.resolution.at(fourier).at_frequency(point)
        balance.contact(*balance.split(orbit))
        motions = self.motions(float(point[-1]))
        return motions.multipliers(balance.contact, float(orbit[-1]))

    def largest(self, point: Array, resolutions: Iterable[FourierBasis]) -> list[float]:
        """Return the largest modulus of the orbit at a point with each resolution.

        Infinite where there is none, or where multipliers are not known.
        """
        orbits = [(self.orbits.finer(point, each), each) for each in resolutions]
        known = (
            self.at(orbit, each) if orbit is not None else np.empty(0)
            for orbit, each in orbits
        )
        return [float(np.abs(each).max()) if each.size else math.inf for each in known]

    def sure(
        self,
        point: Array,
        fourier: FourierBasis,
        normal_smallest: Array,
        coarser: tuple[Array, FourierBasis] | None = None,
        along: Array | None = None,
    ) -> tuple[ComplexArray, FourierBasis, bool]:
        """Return the multipliers, of more harmonics if they ask for it, and which.

        None if they are in doubt even then. With them comes whether the orbit is
        confirmed: where friction falls it must be found with more harmonics too.

        Parameters
        ----------
        point, fourier
            An orbit and its resolution.
        normal_smallest
            Of each contact point that can lift off, during a period [N].
        coarser
            The same orbit with fewer harmonics, if it is known.
        along
            Tangent of the curve there, if it is known: beside a fold there are two
            orbits at one parameter, or none.
        """
        known = self.at(point, fourier)
        falls = self._falls(point, fourier)
        asks = falls or _rattles(normal_smallest)
        if self.fixed or known.size == 0 or not asks:
            return known, fourier, True
        before = self.at(*coarser) if coarser and not falls else known
        if coarser and not falls and _change(before, known) < ALIKE:
            return known, fourier, True
        orbit, trusted, confirmed = point, fourier, True
        most = self._most(falls=falls)
        while fourier.harmonics < most:
            fourier = _finer(fourier, most)
            found = self.orbits.finer(orbit, fourier, along)
            confirmed = found is not None or not falls
            if found is None:
                continue
            orbit, before = found, known
            known, trusted = self.at(orbit, fourier), fourier
            if _change(before, known) < CHANGE:
                break
        if _doubtful(before, known):
            known = np.empty(0, complex)
        return known, trusted, confirmed

    def _most(self, *, falls: bool) -> int:
        """Return the harmonics that are not exceeded for multipliers alone."""
        if falls:
            return HARMONICS
        harmonics = HARMONICS
        while (4 * harmonics + 3) * self.resolution.rank <= UNKNOWNS:
            harmonics = 2 * harmonics + 1
        return min(harmonics, FINEST)

    def _falls(self, point: Array, fourier: FourierBasis) -> bool:
        """Return whether friction falls, or nearly, on an orbit just looked at."""
        balance, _ = self.resolution.at(fourier).at_frequency(point)
        points, (_, velocity) = balance.contact.points, balance.contact.moved
        speeds = np.hypot(velocity[1::3], velocity[2::3]).max(axis=1, initial=0.0)
        falling = (points.friction == GENERAL_KINETIC) & (
            points.static > points.dynamic
        )
        peak = np.minimum(points.threshold, points.stribeck)
        return bool((falling & (speeds > NEARLY * peak)).any())


def _rattles(normal_smallest: Array) -> bool:
    lifts = np.count_nonzero(normal_smallest <= 0.0)
    return bool(lifts > 0 and lifts >= RATTLING * normal_smallest.size)


def _finer(fourier: FourierBasis, most: int) -> FourierBasis:
    finer = fourier.doubled
    return replace(finer, harmonics=min(finer.harmonics, most))


def _change(before: ComplexArray, after: ComplexArray) -> float:
    """Return by how much the leading multipliers differ, paired as they are nearest.

    By their values, not moduli: a pair on its way to the real axis, where it parts,
    need not change its modulus. One that there is in either alone, of a slider that
    never slips in the other, counts as a whole.
    """
    leading = np.zeros((2, LEADING), complex)
    for row, each in zip(leading, (before, after), strict=True):
        some = each[:LEADING]
        row[: each.size] = some.real + 1j * np.abs(some.imag)
    apart = np.abs(leading[0][:, None] - leading[1])
    return float(apart[linear_sum_assignment(apart)].max())


def _doubtful(before: ComplexArray, after: ComplexArray) -> bool:
    """Return whether stability turns on the order, and multipliers change by much."""
    return outside(before) != outside(after) and _change(before, after) > DOUBT
