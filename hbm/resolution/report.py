"""A settled point as it is reported: corrected, with its error (theory §6.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hbm.continuation.arc import tangent
from hbm.continuation.correction import Correction
from hbm.continuation.linearised import SingularError
from hbm.forces.fourier import FourierBasis
from hbm.resolution.estimate import Estimate
from hbm.resolution.resolution_choice import MARKED
from microslip_mechanics.arrays import Array

WORTHLESS = 1.0
"""error of a corrected point, relative, with which it tells less than the point"""


@dataclass(frozen=True, slots=True)
class Report:
    """What is reported of a settled point."""

    estimate: Estimate | None
    """None if the point lies on a fold or none is asked for"""
    settled: FourierBasis
    """resolution of the point"""
    estimates: bool
    """whether errors are estimated"""
    corrects: bool
    """whether the corrected point is reported, as it is by tolerance"""
    most: int
    """number of harmonics that are not exceeded"""

    def kept(self, point: Array) -> tuple[Array, FourierBasis, float]:
        """Return the settled point as it is to be reported, its resolution and error.

        With a tolerance it is the corrected one, unless all of that is in doubt; fixed
        harmonics stay what they are, and have the error of what is not corrected.
        """
        if not self.estimates:
            return point, self.settled, math.nan
        if self.estimate is None or math.isinf(self.estimate.error):
            return point, self.settled, math.inf
        if self._as_settled(self.estimate):
            return point, self.settled, self.estimate.before
        return self.estimate.corrected, self.estimate.fourier, self.estimate.error

    @property
    def aside(self) -> float:
        """Error of the parameter of the settled point, a fold, as it is reported."""
        if not self.estimates:
            return math.nan
        if self.estimate is None or math.isinf(self.estimate.error):
            return math.inf
        shift = self.estimate.shift if self._as_settled(self.estimate) else 0.0
        return shift + self.estimate.aside

    def _as_settled(self, estimate: Estimate) -> bool:
        """Return whether the point is reported as it was settled."""
        return not self.corrects or estimate.error >= WORTHLESS

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
        if fourier.doubled.harmonics > 2 * self.most + 1:  # points have no more room
            return as_settled
        try:
            along = tangent(estimate.slope, correction.along, scale)
        except SingularError:
            return as_settled
        return replace(correction, point=point, tangent=along), fourier
