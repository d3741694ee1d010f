"""Lengths of the steps along a curve (theory §6.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

LONGER, SHORTER = 2.0, 0.3
"""factors between which a step changes"""
HARD = 0.7
"""factor at the most, where Newton's iteration was slow"""
EXACT = 1e-9
"""miss of an extrapolation that is none"""


@dataclass(frozen=True, slots=True)
class StepControl:
    """Arc-length steps that are as long as extrapolation is good."""

    initial: float = 0.02
    smallest: float = 1e-7
    largest: float = 0.25
    miss: float = 0.02
    """by which a predicted point may be wrong"""
    many_iterations: int = 12
    """of Newton: with more the iteration was slow"""
    slack: float = 0.01
    """distance by which a correction may leave the prediction in any case"""
    shift: float = 0.03
    """the same where the system is finer or coarser than at the last point"""
    tolerance: float = 1e-9
    """of the largest residual"""
    negligible: float = 0.0
    """length of a step of Newton's iteration that is the last one, if …"""
    loose: float = 0.0
    """… the residual is not larger"""
    most_points: int = 5000
    """after which a curve is given up"""
    sharpest_turn: float = 0.5
    """a step turns the tangent by no more than what has this cosine"""
    narrowest: float = 4e-3
    """length of a step that overlooks nothing"""

    def __post_init__(self) -> None:
        """Check the order of the steps."""
        if not 0.0 < self.smallest <= self.initial <= self.largest:
            raise ValueError(
                f"steps {self.smallest:g}, {self.initial:g}, {self.largest:g}: give "
                "0 < smallest <= initial <= largest"
            )
        if not 0.0 <= self.negligible < self.miss:
            raise ValueError(
                f"negligible step {self.negligible:g}: give 0 or more, and less than "
                f"{self.miss:g}"
            )
        if self.tolerance <= 0.0:
            raise ValueError(f"tolerance {self.tolerance:g}: give a positive one")

    @property
    def strict(self) -> StepControl:
        """The same without neglecting any step of Newton's iteration."""
        return replace(self, negligible=0.0)

    def after(self, step: float, missed: float, order: int, iterations: int) -> float:
        """Return the next step.

        It grows or shrinks so that the extrapolation misses the next point by
        :attr:`miss`; it shrinks if Newton's iteration was slow all the same.

        Parameters
        ----------
        step, missed
            Last step, and by how much extrapolation missed the point there.
        order
            Of the extrapolation.
        iterations
            Of Newton.
        """
        factor = math.pow(self.miss / max(missed, EXACT), 1.0 / (order + 1))
        if iterations > self.many_iterations:
            factor = min(factor, HARD)
        changed = step * min(max(factor, SHORTER), LONGER)
        return min(max(changed, self.smallest), self.largest)
