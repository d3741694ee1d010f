"""The harmonics and samples that an error asks for, from point to point (§6.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hbm.forces.fourier import FourierBasis, usual_samples
from hbm.resolution.estimate import Estimate

FEWEST, MOST_SAMPLES = FourierBasis(1, 32, math.inf), 16384
"""least resolution, and most samples, that are chosen"""
PER_ORDER, ANEW = 8, 128
"""samples per order at the least, the mean counted: twice what a Jacobian needs; and
with which a curve begins anew at the least"""
SPARE = 6.0
"""times that the error may be below its tolerance before less is taken"""
LITTLE = 1e-3
"""part of such an error, from which on an eighth of the harmonics is taken, not half"""
SHARPER = 4.0
"""times that a threshold velocity falls where friction is to be resolved better"""
MARKED = 127
"""harmonics from which an event is no more accurate than any other point"""


@dataclass(frozen=True, slots=True)
class ResolutionChoice:
    """Chooses resolutions by an error tolerance; without one they stay as they are."""

    tolerance: float | None
    """relative error of the amplitude"""
    most: int
    """number of harmonics that are not exceeded"""
    smoothest: float
    """threshold velocity of friction that is not exceeded"""

    def finer(
        self, fourier: FourierBasis, estimate: Estimate, share: float, sharpest: float
    ) -> FourierBasis:
        """Return the resolution that the error asks for.

        ``share`` is that of the error that is allowed with fewer than :data:`MARKED`
        harmonics. Friction as sharp as ``sharpest`` does not become sharper, nor any as
        long as more harmonics or samples are asked for: both at once lead so far that
        Newton's iteration loses the point.
        """
        if fourier.harmonics >= MARKED:
            share = 1.0
        if self.tolerance is None or estimate.error <= share * self.tolerance:
            return fourier
        parts = 3.0 if self.smoothest else 2.0  # of an error; all may be as large
        enough = share * self.tolerance / parts
        finer = self.doubled(
            fourier,
            harmonics=estimate.truncation > enough,
            samples=estimate.sampling > enough,
        )
        sharpens = estimate.smoothing > enough and fourier.threshold > sharpest
        if finer == fourier and sharpens:
            return replace(fourier, threshold=fourier.threshold / SHARPER)
        return finer

    def anew(self, harmonics: int) -> FourierBasis:
        """Return the resolution with which a curve begins anew, with so many harmonics.

        Or with the most; friction is as smooth as it may be.
        """
        harmonics = min(harmonics, self.most)
        samples = max(ANEW, PER_ORDER * (harmonics + 1))
        return FourierBasis(harmonics, samples, self.smoothest)

    def doubled(
        self, fourier: FourierBasis, *, harmonics: bool = True, samples: bool = True
    ) -> FourierBasis:
        """Return a resolution with twice the harmonics, and twice the samples."""
        orders, count = fourier.harmonics, fourier.samples
        if harmonics:
            orders = min(2 * orders + 1, self.most)
        if samples:
            count = min(2 * count, MOST_SAMPLES)
        count = max(count, PER_ORDER * (orders + 1))
        return FourierBasis(orders, count, fourier.threshold)

    def raised(self, fourier: FourierBasis) -> FourierBasis:
        """Return twice the harmonics, or the most, with as many samples as usual."""
        orders = min(2 * fourier.harmonics + 1, self.most)
        samples = max(fourier.samples, usual_samples(orders))
        return FourierBasis(orders, samples, fourier.threshold)

    def coarser(
        self, fourier: FourierBasis, estimate: Estimate, fewest: FourierBasis
    ) -> FourierBasis:
        """Return the resolution for the next point, less where much is to spare.

        It has no less harmonics and samples than ``fewest``, and no smoother friction.
        """
        if self.tolerance is None:
            return fourier
        harmonics, samples = fourier.harmonics, fourier.samples
        enough = self.tolerance / SPARE
        if estimate.truncation < enough:
            harmonics //= 2
        if estimate.truncation < LITTLE * enough:
            harmonics //= 4
        if estimate.sampling < enough:
            samples //= 2
        harmonics = max(harmonics, fewest.harmonics)
        threshold = fourier.threshold
        if estimate.smoothing < enough / SHARPER:
            threshold = min(SHARPER * threshold, self.smoothest, fewest.threshold)
        samples = max(samples, fewest.samples, PER_ORDER * (harmonics + 1))
        return FourierBasis(harmonics, samples, threshold)
