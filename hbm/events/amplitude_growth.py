"""How the largest amplitude of a response grows along its curve: none at a peak."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hbm.continuation.correction import Correction
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array

FLAT = 1e-13
"""change of an amplitude, relative, that may be rounding"""
EQUAL = 1e-9
"""difference of amplitudes, relative, up to which either may be the largest: one of
them stands for all, on both sides of a peak"""


@dataclass(frozen=True, slots=True)
class AmplitudeGrowth:
    """Correction ↦ change of the largest amplitude along the curve, within a range."""

    resolution: PathResolution
    limits: tuple[float, float]
    """of the parameter, the least first"""

    def __call__(self, correction: Correction) -> float:
        """Return the change of the largest amplitude, over arc length."""
        point, along = correction.point, correction.along
        # Without contact the frequency is all that changes.
        moved = slice(None, -1) if along[:-1].any() else slice(-1, None)
        # At rest any change does: to both sides the amplitude is the same.
        size = float(np.linalg.norm(point[moved])) or 1.0
        small = 1e-6 * size / float(np.linalg.norm(along[moved]))
        # Beyond an end of the range nothing is looked at.
        least, most = self.limits
        back, on = (
            step if least <= point[-1] + step * along[-1] <= most else 0.0
            for step in (-small, small)
        )
        if on == back:
            return 0.0
        sizes = self.resolution.amplitudes([point + back * along, point + on * along])
        place = int((sizes[0] >= (1.0 - EQUAL) * sizes[0].max()).argmax())
        change = float(sizes[1][place] - sizes[0][place])
        rounding = FLAT * float(sizes[0][place])
        return 2.0 * change / (on - back) if abs(change) > rounding else 0.0

    def over(self, correction: Correction, reported: Array, arc: float) -> float:
        """Return the change over an arc, relative to the amplitude at a reported point.

        The growth is that of the correction; over no arc none is needed.
        """
        if arc == 0.0 or math.isinf(arc):
            return arc
        return abs(self(correction)) * arc / float(self.largest(reported)[0])

    def largest(self, *points: Array) -> Array:
        """Return the largest amplitude at each point, shape (points,)."""
        largest: Array = self.resolution.amplitudes(list(points)).max(axis=1)
        return largest
