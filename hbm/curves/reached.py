"""A response with some residual tractions, and what others would change (§6.5)."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hbm.balance.residual import HarmonicBalance
from hbm.curves.leeway import Leeway
from microslip_mechanics.arrays import Array

GAIN = 1e-3
"""relative change of an amplitude that counts"""


@dataclass(frozen=True)
class Reached:
    """A response with some residual tractions."""

    balance: HarmonicBalance
    point: Array
    rows: Array
    """probes of the motion, shape (probes, dofs)"""

    @cached_property
    def amplitude(self) -> Array:
        """Of the probes [m], shape (probes,)."""
        found: Array = np.hypot(*(self.balance.motion(self.point)[1:3] @ self.rows.T))
        return found

    @cached_property
    def leeway(self) -> Leeway:
        """What other tractions change, to first order."""
        return Leeway.of(self.balance, self.point, self.rows)

    def beyond(self, other: Reached, probe: int, sign: float) -> bool:
        """Return whether the amplitude of a probe is farther than another one."""
        gained = sign * (self.amplitude[probe] - other.amplitude[probe])
        return bool(gained > GAIN * other.amplitude[probe])
