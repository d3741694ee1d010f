"""What contacts were asked last, lest the same be evaluated twice."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array


class LastCall(NamedTuple):
    """The last question and its answer, whose samples still lie in the buffers."""

    number: int
    motion: tuple[float, float]
    """frequency and decay"""
    coefficients: Array
    force: Array

    def answers(
        self, number: int, motion: tuple[float, float], coefficients: Array
    ) -> bool:
        """Return whether the same is asked, and nothing else since."""
        same = (self.number, self.motion) == (number, motion)
        return same and np.array_equal(self.coefficients, coefficients)
