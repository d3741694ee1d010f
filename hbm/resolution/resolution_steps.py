"""The resolution at present, as it steps up and down along a curve (theory §6.3)."""

from __future__ import annotations

from hbm.forces.fourier import FourierBasis
from hbm.resolution.estimate import Estimate
from hbm.resolution.resolution_choice import FEWEST, ResolutionChoice

SHORT = 0.01
"""step from which on less is tried"""
WAIT = 10
"""points before less is tried again, where more was needed"""
PATIENCE, FEW, PATIENT = 3, 8, 6
"""failures in a row before the resolution is raised: with fewer harmonics than the
second the first, else the third; what goes round a corner takes short steps, not more
"""
RAISES = 4
"""times that it is raised for failures"""


class ResolutionSteps:
    """Resolutions of one point after another, each by what became of those before."""

    def __init__(self, choice: ResolutionChoice, start: FourierBasis) -> None:
        """Begin with ``start``; friction is never smoother than there."""
        self._choice = choice
        self.present = self.settled = self._kept = start
        self._wait, self._sharpest, self._fewest = 0, 0.0, FEWEST

    @property
    def changed(self) -> bool:
        """Whether the present one is another than that of the last kept point."""
        return self.present != self._kept

    @property
    def finer_now(self) -> bool:
        """Whether the present one has more harmonics than the last kept point."""
        return self.present.harmonics > self._kept.harmonics

    @property
    def doubled(self) -> FourierBasis:
        """Twice the present one."""
        return self._choice.doubled(self.present)

    def restart(self, harmonics: int) -> None:
        """Begin anew with so many harmonics, or the most, unless they are fixed."""
        if self._choice.tolerance is not None:
            self.present = self._kept = self._choice.anew(harmonics)
            self._sharpest, self._fewest = 0.0, FEWEST

    def raise_floor(self) -> bool:
        """Take twice the harmonics of the last kept point, or the most, from now on.

        And as many samples as are usual. Return whether that is more; never if they are
        fixed.
        """
        if self._choice.tolerance is None:
            return False
        before = self._kept
        self.present = self._kept = self._fewest = self._choice.raised(before)
        return self._kept != before

    def settle(self) -> None:
        """Note that a point is settled with the present one."""
        self.settled = self.present

    def finer(self, estimate: Estimate, share: float) -> FourierBasis:
        """Return what an error asks for, ``share`` of which is allowed."""
        sharpest = self._sharpest if self.exhausted else 0.0
        return self._choice.finer(self.present, estimate, share, sharpest)

    def refine(self, finer: FourierBasis) -> None:
        """Take a finer one; none that is coarser for a while."""
        self.present, self._wait = finer, WAIT

    def blunted(self) -> bool:
        """Go back to the settled one if friction is only sharper now, and as can be.

        Return whether that was so; friction does not become as sharp again for a while.
        """
        sharper = self.present.threshold < self.settled.threshold
        if not (sharper and self.exhausted):
            return False
        self.present, self._sharpest = self.settled, self.settled.threshold
        return True

    def keep(self, estimate: Estimate | None, step: float) -> None:
        """Let the next point have the resolution that the last one asks for.

        A coarser one only after a step that is longer than what this may move a point:
        it would not find the way round a corner that the finer one has seen.
        """
        self._kept, self._wait = self.settled, self._wait - 1
        if estimate is not None and self._wait <= 0 and step >= SHORT:
            self.present = self._choice.coarser(self.present, estimate, self._fewest)
            self._sharpest = 0.0

    def hold(self) -> None:
        """Note that the last kept point has been solved with the present one."""
        self._kept = self.present

    def retreat(self, times: int) -> None:
        """Go back to the resolution of the last kept point, then to finer ones.

        Coarse samples make the residual less smooth than the contacts are. What fails
        with the resolution that worked before does not fail for want of it: less is
        tried again at the next point.
        """
        tried, kept = self.present, self._kept
        if tried.harmonics < kept.harmonics or tried.samples < kept.samples:
            self._wait = WAIT
        self.present = kept
        if self._choice.tolerance is not None:
            patience = PATIENCE if kept.harmonics < FEW else PATIENT
            for _ in range(min(times // patience, RAISES)):
                self.present = self.doubled
                self._wait = 0

    @property
    def exhausted(self) -> bool:
        """Whether the last settled point has the most harmonics."""
        return self.settled.harmonics >= self._choice.most
