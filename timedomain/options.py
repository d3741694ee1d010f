"""What a march is asked for: method, step or tolerance, and what is stored."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from microslip_mechanics.errors import MicroslipError

Method = Literal["fast", "reference"]
METHODS = ("fast", "reference")
MOST_DIVISIONS = 20
"""a step in a million parts"""
FINEST = 1e-14
"""least tolerance: what is below is rounding, however short the steps"""


class IntegrationError(MicroslipError):
    """A time step that does not converge, however short."""


@dataclass(frozen=True, slots=True)
class MarchOptions:
    """Step size, storage and accuracy of a march."""

    time_step: float = 2.5e-5
    """longest step [s]; the last step ends exactly at the history's end"""
    store_every: int = 10
    """steps per stored row"""
    tolerance: float | None = None
    """of dissipated energy and peak amplitude, relative: it sets the steps of the fast
    method, which then end on the stored rows; without one they are ``time_step``"""
    method: Method = "fast"
    """the fast method, or average acceleration as a reference"""
    residual: float = 1e-9
    """of contact forces, relative, at which Newton's method ends"""
    divisions: int = 10
    """how often a step that does not converge is halved"""
    estimate: bool = False
    """of the errors by a march with steps of twice the length beside, which costs half
    as much again; a tolerance has estimates of its own too, by its steps"""

    def __post_init__(self) -> None:
        """Check that each option is one that a march can use."""
        if not 0.0 < self.time_step < math.inf:
            raise ValueError(
                f"time step {self.time_step:g} s: give a positive finite one"
            )
        if not 1 <= self.store_every < math.inf:
            raise ValueError(f"store every {self.store_every} steps: give at least 1")
        if not 1 <= self.divisions <= MOST_DIVISIONS:
            raise ValueError(
                f"{self.divisions} divisions of a step: give 1 to {MOST_DIVISIONS}"
            )
        self._check_method()

    def _check_method(self) -> None:
        if self.method not in METHODS:
            raise ValueError(
                f"method {self.method!r}: give one of {', '.join(METHODS)}"
            )
        if not 0.0 < self.residual < 1.0:
            raise ValueError(
                f"residual {self.residual:g}: give one between 0 and 1, such as 1e-9"
            )
        if self.tolerance is None:
            return
        if not FINEST <= self.tolerance < 1.0:
            raise ValueError(
                f"tolerance {self.tolerance:g}: give one between {FINEST:g} and 1, "
                "such as 1e-3"
            )
        if self.method == "reference":
            raise ValueError(
                "the reference method has a fixed step: give no tolerance, or the fast "
                "method"
            )
