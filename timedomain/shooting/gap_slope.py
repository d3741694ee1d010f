"""How the gap between end and beginning of a period goes with the state (§7.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from timedomain.shooting.period_map import Period, PeriodMap
from timedomain.shooting.period_sensitivity import sensitivity_of

NEUTRAL = 1e-10
"""of the largest singular value: below it a direction stays where it is"""


@dataclass(frozen=True, slots=True)
class GapSlope:
    """1 − Φ at a period, in singular values; stuck sliders have what they can shed."""

    left: Array
    sizes: Array
    right: Array
    stuck: NDArray[np.bool_]
    """sliders that never slip in the period"""

    @classmethod
    def of(cls, period_map: PeriodMap, period: Period) -> GapSlope:
        """Return the derivative of minus the gap by the state."""
        monodromy, shed = sensitivity_of(period_map, period)
        slope = np.eye(len(monodromy)) - monodromy
        stuck = period.slides.stuck
        slope[len(slope) - stuck.size :][stuck] = -shed[stuck]
        return cls(*np.linalg.svd(slope), stuck)

    @property
    def neutral(self) -> int:
        """Number of directions in which nothing pins the state."""
        return int((~self._kept).sum())

    def change(self, gap: Array) -> Array:
        """Return Newton's change of least norm, without the neutral directions."""
        kept = self._kept
        along = (self.left[:, kept].T @ gap) / self.sizes[kept]
        change: Array = self.right[kept].T @ along
        return change

    def holds(self, period: Period) -> bool:
        """Return whether the same sliders are stuck in another period."""
        return np.array_equal(self.stuck, period.slides.stuck)

    @property
    def _kept(self) -> NDArray[np.bool_]:
        kept: NDArray[np.bool_] = self.sizes > NEUTRAL * self.sizes[0]
        return kept
