"""Harmonics and samples that follow an error tolerance from point to point (§6.3)."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.effort import Effort
from hbm.continuation.linearised import Linearised, SingularError
from hbm.continuation.newton import Small, correct
from hbm.forces.fourier import FourierBasis
from hbm.resolution.estimate import Estimate
from hbm.resolution.report import Report
from hbm.resolution.resolution import Resolution
from hbm.resolution.resolution_choice import FEWEST, ResolutionChoice
from hbm.structure.superharmonics import Superharmonics
from microslip_mechanics.arrays import Array

HARMONICS = 255
"""most that are solved for"""
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
        self._sharpest, self._fewest = 0.0, FEWEST
        self._choice = ResolutionChoice(tolerance, most, start.threshold)
        self._estimates = errors or tolerance is not None
        self.estimate: Estimate | None = None
        """of the last settled point; None if it lies on a fold or none is asked for"""
        orders = 2 * (start.harmonics if tolerance is None else most) + 1
        self.size = (2 * orders + 1) * resolution.rank + 1

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        """Return residual and derivative at the present resolution."""
        self._effort.spend(self.fourier.harmonics)
        return self._resolution.at(self.fourier)(point)

    @contextlib.contextmanager
    def resolved(self, fourier: FourierBasis) -> Iterator[None]:
        """Take another resolution for a while."""
        own, self.fourier = self.fourier, fourier
        try:
            yield
        finally:
            self.fourier = own

    def restart(self, harmonics: int) -> None:
        """Begin anew with so many harmonics, or the most, unless they are fixed."""
        if self._tolerance is not None:
            self.fourier = self._kept = self._choice.anew(harmonics)
            self._sharpest, self._fewest = 0.0, FEWEST

    def raise_floor(self) -> bool:
        """Take twice the harmonics of the last kept point, or the most, from now on.

        And as many samples as are usual. Return whether that is more; never if they are
        fixed.
        """
        if self._tolerance is None:
            return False
        before = self._kept
        self.fourier = self._kept = self._fewest = self._choice.raised(before)
        return self._kept != before

    @property
    def changed(self) -> bool:
        """Whether the resolution is another one than that of the last kept point."""
        return self.fourier != self._kept

    def straightened(self, correction: Correction, scale: Array) -> Array | None:
        """Return a guess with more harmonics, if these have another tangent."""
        if self._pushed or self._tolerance is None:
            return None
        reported, _ = self.report.reported(correction, scale)
        ways = correction.along / scale, reported.along / scale
        sizes = [float(np.linalg.norm(way)) for way in ways]
        finer = self._choice.doubled(self.fourier)
        straight = float(ways[0] @ ways[1]) >= STRAIGHT * sizes[0] * sizes[1]
        if straight or finer == self.fourier:
            return None
        self.fourier, self._wait = finer, WAIT
        return reported.point

    def overlooks(self, point: Array, scale: Array, step: float) -> bool:
        """Return whether a step passed the resonance of a higher harmonic."""
        reported, fourier, _ = self.report.kept(point)
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
            self.fourier = self._choice.coarser(
                self.fourier, self.estimate, self._fewest
            )
            self._sharpest = 0.0

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
                self.fourier = self._choice.doubled(self.fourier)
                self._wait = 0

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
        ``tolerance`` and ``small`` are those of
        :func:`~hbm.continuation.newton.correct`, ``share`` that of the error that is
        allowed with fewer than :data:`~hbm.resolution.resolution_choice.MARKED`
        harmonics. With less than the whole, a
        point of unknown error stays as it is; so does one that has the most harmonics
        and whose friction cannot be sharper. ``across`` says that the error is one in
        that plane, as at a fold, not at constant parameter. What is returned may have
        failed.
        """
        while True:
            self.settled = self.fourier
            correction = replace(correction, point=self._truncated(correction.point))
            asked = self._asked(correction, normal, share, across)
            if asked is None:
                return correction
            finer, guess = asked
            self.fourier, self._wait = finer, WAIT
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

    @property
    def report(self) -> Report:
        """What is reported of the last settled point."""
        return Report(
            self.estimate,
            self.settled,
            self._estimates,
            self._tolerance is not None,
            self._most,
        )

    def _asked(
        self, correction: Correction, normal: Array, share: float, across: bool
    ) -> tuple[FourierBasis, Array] | None:
        """Note the error; return the resolution that it asks for, and a guess there.

        None if the point stays as it is.
        """
        if not self._estimates:
            return None
        try:
            estimate = (
                self._resolution.estimate if across else self._resolution.least_estimate
            )
            self.estimate = estimate(correction, self.fourier, normal)
        except SingularError:
            self.estimate = None
            return None
        sharpest = self._sharpest if self._exhausted else 0.0
        finer = self._choice.finer(self.fourier, self.estimate, share, sharpest)
        lost = share < 1.0 and math.isinf(self.estimate.error)
        if finer == self.fourier or lost:
            return None
        return finer, self.estimate.corrected

    @property
    def _exhausted(self) -> bool:
        """Whether the last settled point has the most harmonics."""
        return self.settled.harmonics >= self._most

    def _truncated(self, point: Array) -> Array:
        """Return a point without what a finer one before has left in higher orders."""
        truncated = point.copy()
        truncated[self.fourier.coefficients * self._resolution.rank : -1] = 0.0
        return truncated
