"""The errors of a point's energies, by those of points nearby (theory §6.6)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from hbm.resolution.estimate import Estimate
from hbm.resolution.report import Report
from hbm.resolution.resolution import SMOOTHER
from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class EnergyErrors:
    """What tells by how much energies per period of a settled point may be off."""

    resolution: PathResolution
    report: Report
    point: Array
    """as it was settled"""

    def of(self, told: Array) -> Array:
        """Return the errors [J], (2,).

        ``told`` are the energies [J] that friction and normal damping take out of the
        point as it is reported. As the error of the amplitude, they are NaN if none is
        asked for, and infinite if they are not known.
        """
        kept, fourier, error = self.report.kept(self.point)
        estimate = self.report.estimate
        if estimate is None or not math.isfinite(error):
            return np.full(2, error)
        before = self._taken(self.point, estimate.fourier)
        if fourier == estimate.fourier:
            after, other = told, self._taken(kept, _resampled(fourier))
        else:
            after = other = self._taken(estimate.corrected, estimate.fourier)
        larger = self._larger(kept, fourier, error)
        differences = (
            other - told,
            self._taken(larger, fourier) - told,
            self._left(estimate, before, after),
            self._taken(estimate.beyond, estimate.fourier) - after,
            self._sharper(estimate),
        )
        found: Array = np.abs(differences).sum(axis=0)
        return found

    def _taken(self, point: Array, fourier: FourierBasis) -> Array:
        """Return what friction and normal damping take out per period [J], (2,)."""
        balance, inner = self.resolution.at(fourier).at_frequency(point)
        cycle = balance.cycle(inner)
        return np.array([cycle.friction, cycle.normal_damping])

    def _left(self, estimate: Estimate, before: Array, after: Array) -> Array:
        """Return what further harmonics and steps change after the steps [J], (2,).

        Forces of the contacts fall from octave to octave by a share of which the
        amplitude's error has the square.
        """
        made = estimate.made
        last = after - self._taken(made.before, estimate.fourier)
        beyond = math.sqrt(made.beyond) * np.abs(after - before)
        left: Array = beyond + made.left * np.abs(last)
        return left

    def _larger(self, point: Array, fourier: FourierBasis, error: float) -> Array:
        """Return a point that vibrates by as much more as it may without being seen.

        What is marched is seen at the samples, between which a sine rises higher.
        """
        if self.resolution.marched:
            error += (math.pi / fourier.samples) ** 2 / 2.0
        larger = point.copy()
        larger[self.resolution.rank : -1] *= 1.0 + error
        return larger

    def _sharper(self, estimate: Estimate) -> Array:
        """Return what friction that is resolved changes to first order [J], (2,)."""
        if estimate.resolved is None:
            return np.zeros(2)
        settled = self.report.settled
        smoother = replace(settled, threshold=(1.0 - SMOOTHER) * settled.threshold)
        moved = self._taken(self.point + SMOOTHER * estimate.resolved, smoother)
        return (moved - self._taken(self.point, settled)) / SMOOTHER


def _resampled(fourier: FourierBasis) -> FourierBasis:
    return replace(fourier, samples=2 * fourier.samples)
