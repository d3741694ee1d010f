"""The error of a point, by steps at twice its resolution (theory §6.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hbm.balance.refined import Refined
from hbm.continuation.linearised import Linearised
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array, largest

BEYOND = 1.5
"""times that all harmonics beyond may change what the next octave seems to change"""


@dataclass(frozen=True, slots=True)
class Estimate:
    """What Newton steps at twice the resolution say of a point, and leave."""

    change: float
    """relative change of the amplitude by the steps"""
    truncation: float
    """relative error after the steps: by harmonics that are left out, and by what
    further steps would change; infinite if they lead to no point"""
    sampling: float
    """by the distance of the samples"""
    smoothing: float
    """by friction that is not resolved"""
    shift: float
    """change of the parameter by the steps, across a fold"""
    aside: float
    """error of the parameter after them"""
    fourier: FourierBasis
    """resolution of the corrected point"""
    made: Refined
    """what the steps came to"""
    beyond: Array
    """the point after the steps once harmonics beyond have answered"""
    resolved: Array | None
    """how the point before them changes if friction is resolved; None if it is"""
    values: Array
    """by whose changes errors are measured, in the order of :func:`changes`"""

    @property
    def corrected(self) -> Array:
        """The point after the steps."""
        return self.made.corrected

    @property
    def slope(self) -> Linearised:
        """The derivative of the residual about there."""
        return self.made.slope

    def of(self, value: int) -> tuple[float, float]:
        """Return how one of the values changes by the steps, and its error after."""
        change, truncation, sampling = changes(self.values[:, [value]], self.made)
        return change, truncation + sampling

    @property
    def error(self) -> float:
        """That of the corrected point."""
        return self.truncation + self.sampling + self.smoothing

    @property
    def before(self) -> float:
        """That of the point before the steps."""
        return self.change + self.error


def changes(values: Array, made: Refined) -> tuple[float, float, float]:
    """Return how values change by steps, and how far they are off after them.

    That is by harmonics, and by samples. The rows of ``values`` are those of a point,
    of it solved, solved with more samples, before the last step, after it, of that once
    harmonics beyond have answered, after one step more, and with still more samples, if
    these count.
    """
    before, solved, resampled, after, last, beyond, further, *finest = values
    truncation = made.beyond * largest(last - resampled)
    truncation = max(truncation, BEYOND * largest(beyond - last))
    lost = math.isinf(made.left)
    steps = max(made.left * largest(last - after), largest(further - last))
    truncation += math.inf if lost else steps
    sampling = [resampled - solved, *(each - last for each in finest)]
    return largest(last - before), truncation, max(map(largest, sampling))
