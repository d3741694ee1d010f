"""Harmonics and samples that follow an error tolerance from point to point (§6)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from hbm.arc_step import tangent
from hbm.effort import Effort
from hbm.fourier import FourierBasis
from hbm.newton import (
    Correction,
    Linearised,
    Outcome,
    SingularError,
    Small,
    correct,
)
from hbm.resolution import Estimate, Resolution
from hbm.superharmonics import Superharmonics
from microslip_mechanics.arrays import Array

HARMONICS = 255
"""most that are solved for"""
FEWEST_SAMPLES, MOST_SAMPLES = 32, 16384
STEEP = 0.05
"""error at constant frequency from which a fold may be near"""
SPARE = 6.0
"""times that the error may be below its tolerance before less is taken"""
SHARPER = 4.0
"""times that a threshold velocity falls where friction is to be resolved better"""
MARKED = 127
"""harmonics from which an event is no more accurate than any other point"""
SHORT = 0.01
"""step from which on less is tried"""
WAIT = 10
"""points before less is tried again, where more was needed"""
PERSEVERANCE = 30
"""iterations of Newton after the resolution has been raised"""
PATIENCE, FEW, PATIENT = 3, 8, 6
"""failures in a row before the resolution is raised: with fewer harmonics than the
second the first, else the third; what goes round a corner takes short steps, not more
"""
RAISES = 4
"""times that it is raised for failures"""
STRAIGHT = 0.8
"""cosine between the tangents where a point is settled and where it is reported, below
which the first belongs to a fold that more harmonics do not have
"""


class AdaptiveBalance:
    """A system whose resolution changes from point to point, as the error asks for.

    Points have room for :attr:`size` components, whatever their resolution.
    """

    def __init__(
        self,
        resolution: Resolution,
        start: FourierBasis,
        *,
        tolerance: float | None,
        most: int = HARMONICS,
        errors: bool = True,
        effort: Effort | None = None,
        pushed: bool = False,
    ) -> None:
        """Begin with ``start``; without ``tolerance`` stay there.

        Friction is never smoother than that of ``start``.

        ``tolerance`` is the relative error of the amplitude at each point; ``most`` the
        number of harmonics that are not exceeded. Without ``errors`` those of a fixed
        resolution are not estimated. ``effort`` counts the evaluations. ``pushed``
        says that pushes on rigid contacts are among the components: they jump, so that
        they turn the tangent with every harmonic.
        """
        self._resolution, self._tolerance, self._most = resolution, tolerance, most
        self.fourier = self.settled = self._kept = start
        self._pushed = pushed
        self._wait, self._effort = 0, effort or Effort()
        self._superharmonics = Superharmonics()
        self._smoothest, self._sharpest = start.threshold, 0.0
        self._estimates = errors or tolerance is not None
        self.estimate: Estimate | None = None
        """of the last settled point; None if it lies on a fold or none is asked for"""
        orders = 2 * (start.harmonics if tolerance is None else most) + 1
        self.size = (2 * orders + 1) * resolution.rank + 1

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        """Return residual and derivative at the present resolution."""
        self._effort.spend(self.fourier.harmonics)
        return self._resolution.at(self.fourier)(point)

    def restart(self, harmonics: int) -> None:
        """Begin anew with so many harmonics, or the most, unless they are fixed."""
        if self._tolerance is not None:
            harmonics = min(harmonics, self._most)
            samples = max(128, 8 * (harmonics + 1))
            self.fourier = FourierBasis(harmonics, samples, self._smoothest)
            self._kept, self._sharpest = self.fourier, 0.0

    @property
    def changed(self) -> bool:
        """Whether the resolution is another one than that of the last kept point."""
        return self.fourier != self._kept

    def straightened(self, correction: Correction, scale: Array) -> Array | None:
        """Return a guess with more harmonics, if these have another tangent."""
        if self._pushed or self._tolerance is None:
            return None
        reported, _ = self.reported(correction, scale)
        ways = correction.along / scale, reported.along / scale
        sizes = [float(np.linalg.norm(way)) for way in ways]
        finer = self._doubled(True, True)
        straight = float(ways[0] @ ways[1]) >= STRAIGHT * sizes[0] * sizes[1]
        if straight or finer == self.fourier:
            return None
        self.fourier, self._wait = finer, WAIT
        return reported.point

    def overlooks(self, point: Array, scale: Array, step: float) -> bool:
        """Return whether a step passed the resonance of a higher harmonic."""
        reported, fourier, _ = self.kept(point)
        rank = self._resolution.rank
        orders = slice(rank, fourier.coefficients * rank)
        waves = (reported[orders] / scale[orders]).reshape(fourier.harmonics, 2, rank)
        return self._superharmonics.passed(waves[:, 0] - 1j * waves[:, 1], step)

    def keep(self, step: float = math.inf) -> None:
        """Let the next point have the resolution that the last one asks for.

        A coarser one only after a step that is longer than what this may move a point:
        it would not find the way round a corner that the finer one has seen.
        """
        self._kept, self._wait = self.settled, self._wait - 1
        self._superharmonics.keep()
        if self.estimate is not None and self._wait <= 0 and step >= SHORT:
            self.fourier, self._sharpest = self._coarser(self.estimate), 0.0

    def retreat(self, times: int) -> None:
        """Go back to the resolution of the last kept point, then to finer ones.

        Coarse samples make the residual less smooth than the contacts are. What fails
        with the resolution that worked before does not fail for want of it: less is
        tried again at the next point.
        """
        tried, kept = self.fourier, self._kept
        if tried.harmonics < kept.harmonics or tried.samples < kept.samples:
            self._wait = WAIT
        self.fourier = kept
        if self._tolerance is not None:
            patience = PATIENCE if kept.harmonics < FEW else PATIENT
            for _ in range(min(times // patience, RAISES)):
                self.fourier, self._wait = self._doubled(True, True), 0

    def settle(
        self,
        correction: Correction,
        normal: Array,
        tolerance: float,
        small: Small | None = None,
        *,
        share: float = 1.0,
        across: bool = False,
    ) -> Correction:
        """Refine a converged point until its error is small enough, and note the error.

        The refined point lies in the plane through it, normal to ``normal``;
        ``tolerance`` and ``small`` are those of :func:`~hbm.newton.correct`, ``share``
        that of the error that is allowed with fewer than :data:`MARKED` harmonics. With
        less than the whole, a point of unknown error stays as it is; so does one that
        has the most harmonics and whose friction cannot be sharper. ``across`` says
        that the error is one in that plane, not at constant frequency, as at a fold.
        What is returned may have failed.
        """
        while True:
            self.settled = self.fourier
            correction = replace(correction, point=self._truncated(correction.point))
            if not self._estimates:
                return correction
            try:
                self.estimate = self._estimated(correction, normal, across)
            except SingularError:
                self.estimate = None
                return correction
            finer = self._finer(self.estimate, share)
            lost = share < 1.0 and math.isinf(self.estimate.error)
            if finer == self.fourier or lost:
                return correction
            self.fourier, self._wait = finer, WAIT
            guess = self.estimate.corrected
            again = correct(
                self,
                guess,
                normal,
                tolerance=tolerance,
                small=small,
                max_iterations=PERSEVERANCE,
            )
            converged = again.outcome is Outcome.CONVERGED
            sharper = finer.threshold < self.settled.threshold
            if not converged and sharper and self._exhausted:
                self.fourier, self._sharpest = self.settled, self.settled.threshold
                continue
            correction = replace(
                again, residuals=correction.residuals[:-1] + again.residuals
            )
            if not converged:
                return correction

    def _estimated(
        self, correction: Correction, normal: Array, across: bool
    ) -> Estimate:
        """Return the error at constant frequency or, where that is steep, across."""
        if across:
            return self._resolution.estimate(correction, self.fourier, normal)
        upright = np.zeros_like(normal)
        upright[-1] = 1.0
        estimate = self._resolution.estimate(correction, self.fourier, upright)
        if estimate.error < STEEP:
            return estimate
        other = self._resolution.estimate(correction, self.fourier, normal)
        return min(estimate, other, key=lambda each: each.error)

    def kept(self, point: Array) -> tuple[Array, FourierBasis, float]:
        """Return the settled point as it is to be reported, its resolution and error.

        With a tolerance it is the corrected one; fixed harmonics stay what they are,
        and have the error of what is not corrected.
        """
        if not self._estimates:
            return point, self.settled, math.nan
        if self.estimate is None or math.isinf(self.estimate.error):
            return point, self.settled, math.inf
        if self._tolerance is None:
            return point, self.settled, self.estimate.before
        return self.estimate.corrected, self.estimate.fourier, self.estimate.error

    @property
    def aside(self) -> float:
        """Error of the parameter of the settled point, a fold, as it is reported."""
        if not self._estimates:
            return math.nan
        if self.estimate is None or math.isinf(self.estimate.error):
            return math.inf
        uncorrected = self.estimate.shift if self._tolerance is None else 0.0
        return uncorrected + self.estimate.aside

    def reported(
        self, correction: Correction, scale: Array
    ) -> tuple[Correction, FourierBasis]:
        """Return the settled point as it is reported, with the tangent there.

        With more than :data:`MARKED` harmonics it is the point as it was settled.
        """
        point, fourier, _ = self.kept(correction.point)
        estimate, as_settled = self.estimate, (correction, self.settled)
        if estimate is None or fourier == self.settled or fourier.harmonics > MARKED:
            return as_settled
        if fourier.doubled.harmonics > 2 * self._most + 1:  # points have no more room
            return as_settled
        try:
            along = tangent(estimate.slope, correction.along, scale)
        except SingularError:
            return as_settled
        return replace(correction, point=point, tangent=along), fourier

    @property
    def _exhausted(self) -> bool:
        """Whether the last settled point has the most harmonics."""
        return self.settled.harmonics >= self._most

    def _truncated(self, point: Array) -> Array:
        """Return a point without what a finer one before has left in higher orders."""
        truncated = point.copy()
        truncated[self.fourier.coefficients * self._resolution.rank : -1] = 0.0
        return truncated

    def _finer(self, estimate: Estimate, share: float) -> FourierBasis:
        """Return the resolution that the error asks for."""
        if self.fourier.harmonics >= MARKED:
            share = 1.0
        if self._tolerance is None or estimate.error <= share * self._tolerance:
            return self.fourier
        enough = share * self._tolerance / (3.0 if self._smoothest else 2.0)
        finer = self._doubled(estimate.truncation > enough, estimate.sampling > enough)
        sharpest = self._sharpest if self._exhausted else 0.0
        if estimate.smoothing > enough and finer.threshold > sharpest:
            finer = replace(finer, threshold=finer.threshold / SHARPER)
        return finer

    def _doubled(self, harmonics: bool, samples: bool) -> FourierBasis:
        """Return a resolution with twice the harmonics, or samples, or both."""
        orders, count = self.fourier.harmonics, self.fourier.samples
        if harmonics:
            orders = min(2 * orders + 1, self._most)
        if samples:
            count = min(2 * count, MOST_SAMPLES)
        count = max(count, 8 * (orders + 1))
        return FourierBasis(orders, count, self.fourier.threshold)

    def _coarser(self, estimate: Estimate) -> FourierBasis:
        """Return the resolution for the next point, less where much is to spare."""
        if self._tolerance is None:
            return self.fourier
        harmonics, samples = self.fourier.harmonics, self.fourier.samples
        enough = self._tolerance / SPARE
        if estimate.truncation < enough:
            harmonics = max(harmonics // 2, 1)
        if estimate.truncation < 1e-3 * enough:
            harmonics = max(harmonics // 4, 1)
        if estimate.sampling < enough:
            samples //= 2
        threshold = self.fourier.threshold
        if estimate.smoothing < enough / SHARPER:
            threshold = min(SHARPER * threshold, self._smoothest)
        samples = max(samples, FEWEST_SAMPLES, 8 * (harmonics + 1))
        return FourierBasis(harmonics, samples, threshold)
