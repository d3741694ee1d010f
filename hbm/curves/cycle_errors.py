"""The errors of what contacts do in a period, by points nearby (theory §6.6)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hbm.forces.contact_cycle import ContactCycle
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from hbm.resolution.estimate import Estimate
from hbm.resolution.report import Report
from hbm.resolution.resolution import SMOOTHER
from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class CycleErrors:
    """What tells by how much energies and normal forces of a point may be off."""

    resolution: PathResolution
    report: Report
    point: Array
    """as it was settled"""

    def of(self, reported: ContactCycle) -> ContactCycle:
        """Return the errors of the cycle of the point as it is reported.

        As the error of the amplitude, they are NaN if none is asked for, and infinite
        if they are not known.
        """
        kept, fourier, error = self.report.kept(self.point)
        estimate, told = self.report.estimate, reported.values
        if estimate is None or not math.isfinite(error):
            return reported.with_values(np.full(told.size, error))
        before = self._seen(self.point, estimate.fourier)
        if fourier == estimate.fourier:
            after, other = told, self._seen(kept, _resampled(fourier))
        else:
            after = other = self._seen(estimate.corrected, estimate.fourier)
        unseen = (math.pi / fourier.samples) ** 2 / 2.0
        if self.resolution.marched:
            error += unseen
        differences = (
            other - told,
            self._seen(self._larger(kept, error), fourier) - told,
            self._left(estimate, before, after),
            self._seen(estimate.beyond, estimate.fourier) - after,
            self._sharper(estimate, told.size),
            unseen * reported.ranges,
        )
        return reported.with_values(np.abs(differences).sum(axis=0))

    def _seen(self, point: Array, fourier: FourierBasis) -> Array:
        """Return the values of a cycle, at the parameter that is reported.

        Across a fold at the end of a range others lie beyond it, where there may be no
        problem.
        """
        kept, _, _ = self.report.kept(self.point)
        here = np.append(point[:-1], kept[-1])
        balance, inner = self.resolution.at(fourier).at_frequency(here)
        return balance.cycle(inner).values

    def _left(self, estimate: Estimate, before: Array, after: Array) -> Array:
        """Return what further harmonics and steps change after the steps.

        Forces of the contacts fall from octave to octave by a share of which the
        amplitude's error has the square.
        """
        made = estimate.made
        last = after - self._seen(made.before, estimate.fourier)
        beyond = math.sqrt(made.beyond) * np.abs(after - before)
        left: Array = beyond + made.left * np.abs(last)
        return left

    def _larger(self, point: Array, share: float) -> Array:
        """Return a point that vibrates by a share more."""
        larger = point.copy()
        larger[self.resolution.rank : -1] *= 1.0 + share
        return larger

    def _sharper(self, estimate: Estimate, size: int) -> Array:
        """Return what friction that is resolved changes to first order, (size,)."""
        if estimate.resolved is None:
            return np.zeros(size)
        settled = self.report.settled
        smoother = replace(settled, threshold=(1.0 - SMOOTHER) * settled.threshold)
        moved = self._seen(self.point + SMOOTHER * estimate.resolved, smoother)
        return (moved - self._seen(self.point, settled)) / SMOOTHER


def _resampled(fourier: FourierBasis) -> FourierBasis:
    return replace(fourier, samples=2 * fourier.samples)
