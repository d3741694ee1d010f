"""Harmonics and samples that follow an error tolerance from point to point (§6.3)."""

from __future__ import annotations

import contextlib
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from hbm.balance.refined import PATIENT
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.effort import Effort
from hbm.continuation.linearised import Linearised, SingularError
from hbm.continuation.newton import Small, correct
from hbm.forces.fourier import FourierBasis
from hbm.resolution.estimate import Estimate
from hbm.resolution.report import Report
from hbm.resolution.resolution import Resolution
from hbm.resolution.resolution_choice import ResolutionChoice
from hbm.resolution.resolution_steps import ResolutionSteps
from hbm.structure.superharmonics import Superharmonics
from microslip_mechanics.arrays import Array

HARMONICS = 255
"""most that are solved for"""
PERSEVERANCE = 30
"""iterations of Newton after the resolution has been raised"""
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
        self._steps = ResolutionSteps(
            ResolutionChoice(tolerance, most, start.threshold), start
        )
        self._pushed, self._effort = pushed, effort or Effort()
        self._superharmonics = Superharmonics()
        self._estimates = errors or tolerance is not None
        self.estimate: Estimate | None = None
        """of the last settled point; None if it lies on a fold or none is asked for"""
        self._sought: Callable[..., Estimate] = resolution.estimate
        """what has estimated that, with all but the patience given"""
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

    @property
    def fourier(self) -> FourierBasis:
        """The present resolution."""
        return self._steps.present

    @fourier.setter
    def fourier(self, fourier: FourierBasis) -> None:
        self._steps.present = fourier

    @property
    def settled(self) -> FourierBasis:
        """Resolution of the last settled point."""
        return self._steps.settled

    @property
    def changed(self) -> bool:
        """Whether the resolution is another one than that of the last kept point."""
        return self._steps.changed

    @property
    def finer(self) -> bool:
        """Whether there are more harmonics than at the last kept point."""
        return self._steps.finer_now

    def hold(self) -> None:
        """Note that the last kept point has been solved with the present resolution."""
        self._steps.hold()

    def restart(self, harmonics: int) -> None:
        """Begin anew with so many harmonics, or the most, unless they are fixed."""
        self._steps.restart(harmonics)

    def raise_floor(self) -> bool:
        """Take more from now on; return whether that is so, never if it is fixed."""
        return self._steps.raise_floor()

    def straightened(self, correction: Correction, scale: Array) -> Array | None:
        """Return a guess with more harmonics, if these have another tangent."""
        if self._pushed or self._tolerance is None:
            return None
        reported, _ = self.report.reported(correction, scale)
        ways = correction.along / scale, reported.along / scale
        sizes = [float(np.linalg.norm(way)) for way in ways]
        finer = self._steps.doubled
        straight = float(ways[0] @ ways[1]) >= STRAIGHT * sizes[0] * sizes[1]
        if straight or finer == self.fourier:
            return None
        self._steps.refine(finer)
        return reported.point

    def overlooks(self, point: Array, scale: Array, step: float) -> bool:
        """Return whether a step passed the resonance of a higher harmonic."""
        reported, fourier, _ = self.report.kept(point)
        rank = self._resolution.rank
        orders = slice(rank, fourier.coefficients * rank)
        waves = (reported[orders] / scale[orders]).reshape(fourier.harmonics, 2, rank)
        return self._superharmonics.passed(waves[:, 0] - 1j * waves[:, 1], step)

    def keep(self, step: float = math.inf) -> None:
        """Let the next point have the resolution that the last one asks for."""
        self._superharmonics.keep()
        self._steps.keep(self.estimate, step)

    def retreat(self, times: int) -> None:
        """Go back to the resolution of the last kept point, then to finer ones."""
        self._steps.retreat(times)

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
            self._steps.settle()
            correction = replace(correction, point=self._truncated(correction.point))
            asked = self._asked(correction, normal, share, across)
            if asked is None:
                reported, _, _ = self.report.kept(correction.point)
                return replace(correction, reported=reported)
            finer, guess = asked
            self._steps.refine(finer)
            again = correct(
                self,
                guess,
                normal,
                tolerance=tolerance,
                small=small,
                max_iterations=PERSEVERANCE,
            )
            converged = again.outcome is Outcome.CONVERGED
            if not converged and self._steps.blunted():
                continue
            correction = replace(
                again, residuals=correction.residuals[:-1] + again.residuals
            )
            if not converged:
                return correction

    def persevere(self) -> None:
        """Seek the finer point with patience by which the last settled point errs.

        That is if steps have led to none, and if there are no more harmonics. What is
        reported gains by it; a curve goes on as its steps have found it.
        """
        lost = self.estimate is not None and math.isinf(self.estimate.error)
        if lost and self._steps.exhausted:
            with contextlib.suppress(SingularError):
                self.estimate = self._sought(patience=PATIENT)

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
        asked = self._resolution.estimate if across else self._resolution.least_estimate
        seen = correction, self.fourier, normal, self._tolerance or 0.0
        self._sought = partial(asked, *seen)
        try:
            self.estimate = self._sought()
        except SingularError:
            self.estimate = None
            return None
        finer = self._steps.finer(self.estimate, share)
        lost = share < 1.0 and math.isinf(self.estimate.error)
        if finer == self.fourier or lost:
            return None
        return finer, self.estimate.corrected

    def _truncated(self, point: Array) -> Array:
        """Return a point without what a finer one before has left in higher orders."""
        truncated = point.copy()
        truncated[self.fourier.coefficients * self._resolution.rank : -1] = 0.0
        return truncated
