"""A point that Newton's iteration has corrected, and how that ended."""

from __future__ import annotations

import enum
from dataclasses import dataclass

import numpy as np

from hbm.continuation.linearised import Linearised
from microslip_mechanics.arrays import Array


class Outcome(enum.Enum):
    """How a Newton correction ended."""

    CONVERGED = "the residual fell below the tolerance, or the step became negligible"
    EXHAUSTED = "the iteration limit was reached"
    STALLED = "no step along Newton's direction lowers the residual"
    SINGULAR = "the bordered Jacobian is singular"
    OVERFLOW = "the residual is not finite"


@dataclass(frozen=True, slots=True)
class Correction:
    """A point, what the correction saw, and how it ended."""

    point: Array
    residual: Array
    """at the point, shape (n,)"""
    linearised: Linearised
    outcome: Outcome
    residuals: tuple[float, ...]
    """largest residual before the first and after each iteration"""
    tangent: Array | None = None
    """of the curve at the point, shape (n + 1,), if it is known"""
    orientation: float = 0.0
    """that of its linearisation by the tangent; 0 if it is not known"""
    joined: bool = True
    """whether the curve comes from the point before"""
    turns: bool = False
    """whether it comes round a corner at which its parameter turns back"""
    reported: Array | None = None
    """the point as it is reported, with more harmonics perhaps; the same if left out"""
    replaces: int = 0
    """how many points before it are taken back where the curve begins anew"""

    @property
    def along(self) -> Array:
        """The tangent; zero if it is not known."""
        return np.zeros_like(self.point) if self.tangent is None else self.tangent

    @property
    def iterations(self) -> int:
        """Number of Newton steps taken."""
        return len(self.residuals) - 1
