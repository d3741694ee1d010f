"""Multipliers of truncated orbits; of finer ones where these may mislead (theory §6.4).

They may where contacts rattle, and where friction falls with the speed: there a few
harmonics may even balance where no orbit is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from hbm.continuation.arc import upright
from hbm.continuation.correction import Outcome
from hbm.continuation.newton import Small, correct
from hbm.continuation.step_control import StepControl
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from hbm.stability.stability import SmallMotions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.points import GENERAL_KINETIC

RATTLING = 0.5
"""share of the contact points that lift off, from which more harmonics are tried"""
HARMONICS = 63
"""most that are taken for multipliers alone"""
CHANGE = 1e-2
"""of the leading multipliers from one order to the next, from which they are known"""
ALIKE = 1e-3
"""of those from the order that the curve has to that of the reported orbit, up to which
the latter are known: a finer orbit need not be sought"""
LEADING = 3
"""how many of them are looked at"""
ASIDE = 0.02
"""relative change of the amplitude from which a finer orbit is another one"""
CHORD = 0.5
"""share of the residual that a Newton step leaves, below which its factors serve again:
so many harmonics take longer to factor than many steps"""
SMALL = 1e-6
"""relative change of the motion that Newton's iteration may neglect"""


@dataclass(frozen=True, slots=True)
class Multipliers:
    """The Floquet multipliers at points of a path."""

    resolution: PathResolution
    motions: Callable[[float], SmallMotions] | None
    """parameter ↦ the structure for small motions, if stability is wanted"""
    control: StepControl
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

    def sure(
        self,
        point: Array,
        fourier: FourierBasis,
        normal_smallest: Array,
        coarser: tuple[Array, FourierBasis] | None = None,
    ) -> tuple[ComplexArray, FourierBasis, bool]:
        """Return the multipliers, of more harmonics if they ask for it, and which.

        With them comes whether the orbit is confirmed: where friction falls it must be
        found with more harmonics too.

        Parameters
        ----------
        point, fourier
            An orbit and its resolution.
        normal_smallest
            Of each contact point that can lift off, during a period [N].
        coarser
            The same orbit with fewer harmonics, if it is known.
        """
        known = self.at(point, fourier)
        falls = self._falls(point, fourier)
        asks = falls or _rattles(normal_smallest)
        if self.fixed or known.size == 0 or not asks:
            return known, fourier, True
        if coarser and not falls and self._alike(coarser, known):
            return known, fourier, True
        orbit, trusted, confirmed = point, fourier, True
        while fourier.harmonics < HARMONICS:
            fourier = _finer(fourier)
            found = self.finer(orbit, fourier)
            confirmed = found is not None or not falls
            if found is None:
                continue
            orbit, before = found, known
            known, trusted = self.at(orbit, fourier), fourier
            if _change(before, known) < CHANGE:
                break
        return known, trusted, confirmed

    def _alike(self, coarser: tuple[Array, FourierBasis], known: ComplexArray) -> bool:
        """Return whether an orbit with fewer harmonics has the same multipliers."""
        others = self.at(*coarser)
        return others.size == known.size and _change(others, known) < ALIKE

    def _falls(self, point: Array, fourier: FourierBasis) -> bool:
        """Return whether friction falls with the speed on an orbit just looked at."""
        balance, _ = self.resolution.at(fourier).at_frequency(point)
        points, (_, velocity) = balance.contact.points, balance.contact.moved
        speeds = np.hypot(velocity[1::3], velocity[2::3]).max(axis=1, initial=0.0)
        falling = (points.friction == GENERAL_KINETIC) & (
            points.static > points.dynamic
        )
        peak = np.minimum(points.threshold, points.stribeck)
        return bool((falling & (speeds > peak)).any())

    def finer(self, point: Array, fourier: FourierBasis) -> Array | None:
        """Return the orbit at the same parameter with another resolution, if found."""
        vibration = float(np.linalg.norm(point[self.resolution.rank : -1]))
        changes = np.full_like(point, SMALL * vibration)
        found = correct(
            self.resolution.at(fourier),
            point,
            upright(point),
            tolerance=self.control.tolerance,
            small=Small(lambda _: changes, self.control.loose),
            chord=CHORD,
        )
        if found.outcome is not Outcome.CONVERGED:
            return None
        before, after = self.resolution.amplitudes((point, found.point))
        other = np.abs(after - before).max() > ASIDE * before.max()
        return None if other else found.point


def _rattles(normal_smallest: Array) -> bool:
    lifts = np.count_nonzero(normal_smallest <= 0.0)
    return bool(lifts > 0 and lifts >= RATTLING * normal_smallest.size)


def _finer(fourier: FourierBasis) -> FourierBasis:
    finer = fourier.doubled
    return replace(finer, harmonics=min(finer.harmonics, HARMONICS))


def _change(before: ComplexArray, after: ComplexArray) -> float:
    """Return by how much the leading multipliers differ in modulus.

    One that there is in either alone, of a slider that never slips in the other, counts
    as a whole.
    """
    sizes = np.zeros((2, LEADING))
    for row, each in zip(sizes, (before, after), strict=True):
        row[: each.size] = np.abs(each[:LEADING])
    return float(np.abs(sizes[0] - sizes[1]).max())
