"""A system at any number of harmonics and samples: the error of its points (§6.3)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from hbm.balance.beyond import answered, stepped, wider
from hbm.balance.refined import Patience, Refined, Resolved, refined
from hbm.continuation.arc import upright
from hbm.continuation.correction import Correction
from hbm.forces.fourier import FourierBasis
from hbm.resolution.estimate import BEYOND, Estimate, changes
from microslip_mechanics.arrays import Array, ComplexArray, largest

STEEP = 0.05
"""error at constant parameter from which a fold may be near"""
SMOOTHER = 1e-3
"""relative change of a threshold velocity that tells what it does"""
MORE = 4
"""times the samples after the steps, with which marches tell what these err"""
TURNING = 0.25
"""share of a phasor's change that counts where its length just has an extremum"""


class Resolution(ABC):
    """A system at any number of harmonics and samples."""

    rank: int
    """number of components of a point for each Fourier coefficient"""
    marched = False
    """whether contacts are marched from sample to sample: how far a transition is from
    the next sample, by which they err, is an accident at each resolution"""

    @abstractmethod
    def at(self, fourier: FourierBasis) -> Resolved:
        """Return the system at one resolution."""

    @abstractmethod
    def amplitudes(self, points: Sequence[Array]) -> Array:
        """Return the values by whose change an error is measured, (points, values)."""

    def phasors(self, points: Sequence[Array]) -> ComplexArray:
        """Return what these are the moduli of."""
        return self.amplitudes(points).astype(complex)

    def least(self, point: Array) -> float:  # noqa: ARG002
        """Return the size of values at a point below which errors are not relative."""
        return 0.0

    def steepness(self, estimate: Estimate) -> float:
        """Return the error that is large where the curve is steep."""
        return estimate.error

    def estimate(
        self,
        correction: Correction,
        fourier: FourierBasis,
        normal: Array,
        tolerance: float = 0.0,
        patience: Patience | None = None,
    ) -> Estimate:
        """Return the error of a converged point, by steps at twice the order.

        The corrected point lies in the plane through the point that is normal to
        ``normal``. Of changes below ``tolerance`` less is asked. The ``patience`` is
        that of the steps.

        Raises
        ------
        SingularError
            If the point lies on a fold.
        """
        point, finer = correction.point, fourier.doubled
        far = self._apart(tolerance)
        made = refined(self.at(finer), point, finer.harmonics, normal, far, patience)
        beyond = self._beyond(made, finer, normal)
        low = made.residual.copy()
        low[fourier.coefficients * self.rank :] = 0.0
        newton, sampled = (
            correction.linearised.solve(normal, np.append(right, 0.0))
            for right in (correction.residual, low - correction.residual)
        )
        solved = point - newton
        points = (
            point, solved, solved - sampled, made.before, made.corrected,
            beyond, made.further, *self._resampled(made, finer, normal),
        )  # fmt: skip
        sizes = self.amplitudes(points)
        places = np.array([each[-1:] for each in points])
        change, truncation, sampling = changes(sizes, made)
        shift, *aside = changes(places, made)
        resolved = self._resolved(correction, fourier, normal)
        smoothing, moved = self._smoothing(point, resolved)
        size = max(float(sizes[0].max(initial=0.0)), self.least(point)) or 1.0
        turned = largest(np.abs(np.subtract(*self.phasors((beyond, made.corrected)))))
        return Estimate(
            change / size,
            max(truncation, BEYOND * TURNING * turned) / size,
            sampling / size,
            smoothing / size,
            shift,
            sum(aside) + moved,
            finer,
            made,
            beyond,
            resolved,
            sizes,
        )

    def least_estimate(
        self,
        correction: Correction,
        fourier: FourierBasis,
        normal: Array,
        tolerance: float = 0.0,
        patience: Patience | None = None,
    ) -> Estimate:
        """Return the error at constant parameter or, where that is steep, across.

        Arguments and errors are those of :meth:`estimate`.
        """
        here = upright(correction.point)
        estimate = self.estimate(correction, fourier, here, tolerance, patience)
        if self.steepness(estimate) < STEEP:
            return estimate
        other = self.estimate(correction, fourier, normal, tolerance, patience)
        return min(estimate, other, key=self.steepness)

    def _apart(self, tolerance: float) -> Callable[[Sequence[Array]], bool]:
        """Return whether values at the last of points differ by that from another."""

        def apart(points: Sequence[Array]) -> bool:
            *others, last = self.amplitudes(points)
            change = max(largest(each - last) for each in others)
            return change > tolerance * float(last.max(initial=0.0))

        return apart

    def _beyond(self, made: Refined, finer: FourierBasis, normal: Array) -> Array:
        """Return the point after the steps once orders beyond have moved it.

        Those of contacts that remember move it by more than their tangents' mean tells.
        """
        seen = self.at(wider(finer)), made, finer, self.rank, normal
        moved = stepped(*seen) if self.marched else None
        return answered(*seen) if moved is None else moved

    def _resampled(
        self, made: Refined, finer: FourierBasis, normal: Array
    ) -> list[Array]:
        """Return the point after the steps with ever more samples, if it is marched.

        Where loads jump between samples marches are of first order: what so many times
        the samples still err is that share of it.
        """
        if not self.marched:
            return []
        finest = replace(finer, samples=MORE * finer.samples)
        change = self.at(finest).residual(made.corrected) - made.rest
        change *= MORE / (MORE - 1.0)
        return [made.corrected - made.slope.solve(normal, np.append(change, 0.0))]

    def _smoothing(self, smooth: Array, change: Array | None) -> tuple[float, float]:
        """Return what resolved friction changes of amplitudes and the parameter."""
        if change is None:
            return 0.0, 0.0
        before, after = self.phasors((smooth, smooth + change))
        moved = largest(np.abs(after) - np.abs(before))
        moved = max(moved, TURNING * largest(np.abs(after - before)))
        return moved, abs(float(change[-1]))

    def _resolved(
        self, correction: Correction, fourier: FourierBasis, normal: Array
    ) -> Array | None:
        """Return how a point changes, to first order, if friction is resolved.

        None if it is.
        """
        if fourier.threshold == 0.0:
            return None
        smoother = replace(fourier, threshold=(1.0 + SMOOTHER) * fourier.threshold)
        other = self.at(smoother).residual(correction.point)
        slope = (other - correction.residual) / SMOOTHER
        return correction.linearised.solve(normal, np.append(slope, 0.0))
