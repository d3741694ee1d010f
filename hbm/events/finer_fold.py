"""A fold with twice the harmonics and samples: how far one is from it (theory §6.4)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hbm.continuation.correction import Correction
from hbm.continuation.linearised import SingularError
from hbm.events.fold_balance import FoldBalance
from microslip_mechanics.arrays import Array

LITTLE, ROUNDING = 1e-2, 1e-9
"""part of a change that leaves its size known; units of arc that do not matter"""
SOON = 10
"""evaluations in which Newton must find the fold"""


@dataclass(frozen=True, slots=True)
class FinerFold:
    """What tells the errors of folds at the resolution of their curve."""

    system: FoldBalance
    """with twice the harmonics and samples"""
    missing: int
    """components that points of the curve have less"""
    tolerance: float
    """of the largest residual"""

    def errors(self, correction: Correction, scale: Array) -> tuple[float, float]:
        """Return the errors of frequency (relative) and parameter of a fold.

        They are twice the change by twice the harmonics and samples, in the plane
        across the curve: where the series converges like 1/H, as much is still missing.
        They are infinite where Newton does not find that point soon: its residual
        vanishes, or its steps do, beside what they have changed. ``scale`` is the unit
        of arc of each component.
        """
        little = False
        point = guess = self._widened(correction.point)
        normal = self._widened(correction.along / scale**2)
        self.system.begin(correction)
        for _ in range(SOON):
            residual, linearised = self.system(point)
            if not np.all(np.isfinite(residual)):
                break
            if little or np.abs(residual).max() <= self.tolerance:
                frequency, parameter = 2.0 * np.abs(point - guess)[-2:]
                return float(frequency / guess[-2]), float(parameter)
            try:
                step = linearised.solve(normal, np.append(residual, 0.0))
            except SingularError:
                break
            point = point - step
            little = _little(step, point - guess, scale)
        return math.inf, math.inf

    def _widened(self, point: Array) -> Array:
        """Return a point, or a row, with room for the harmonics of the finer system."""
        return np.concatenate([point[:-2], np.zeros(self.missing), point[-2:]])


def _little(step: Array, change: Array, scale: Array) -> bool:
    """Return whether a step moves a fold by rounding, or little beside a change.

    Frequency and parameter tell: the motion at a fold is badly conditioned.
    """
    most = LITTLE * np.abs(change[-2:]) + ROUNDING * scale[-2:]
    return bool(np.all(np.abs(step[-2:]) <= most))
