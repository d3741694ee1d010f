"""Newton corrector on a bordered system; knows no physics."""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array


class Linearised(Protocol):
    """The derivative of a residual at a point."""

    def solve(self, normal: Array, right: Array) -> Array:
        """Solve [Jacobian; normal] d = right.

        ``normal`` has shape ``(n + 1,)``, ``right`` that or ``(n + 1, several)``.

        Raises
        ------
        SingularError
            If there is no solution.
        """


class SingularError(ArithmeticError):
    """The bordered Jacobian has no inverse."""


System: TypeAlias = Callable[[Array], tuple[Array, Linearised]]
"""point (n + 1,) ↦ residual (n,) and what solves with its Jacobian"""


class Outcome(enum.Enum):
    """How a Newton correction ended."""

    CONVERGED = "the residual fell below the tolerance"
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

    @property
    def along(self) -> Array:
        """The tangent; zero if it is not known."""
        return np.zeros_like(self.point) if self.tangent is None else self.tangent

    @property
    def iterations(self) -> int:
        """Number of Newton steps taken."""
        return len(self.residuals) - 1


def correct(
    system: System,
    predicted: Array,
    normal: Array,
    *,
    tolerance: float,
    max_iterations: int = 15,
) -> Correction:
    """Bring a predicted point to the curve, within the plane normal to ``normal``.

    Parameters
    ----------
    system
        Residual and Jacobian.
    predicted
        First guess, shape ``(n + 1,)``; the plane goes through it.
    normal
        Row that borders the Jacobian, shape ``(n + 1,)``.
    tolerance
        Of the largest residual.
    max_iterations
        Newton steps before the correction gives up.

    Notes
    -----
    A step that raises the residual is halved, nine times at the most.
    """
    point = predicted
    residual, linearised = system(point)
    sizes = [_size(residual)]
    while True:
        if not np.isfinite(sizes[-1]):
            return Correction(
                point, residual, linearised, Outcome.OVERFLOW, tuple(sizes)
            )
        if sizes[-1] <= tolerance:
            return Correction(
                point, residual, linearised, Outcome.CONVERGED, tuple(sizes)
            )
        if len(sizes) > max_iterations:
            return Correction(
                point, residual, linearised, Outcome.EXHAUSTED, tuple(sizes)
            )
        try:
            step = linearised.solve(normal, np.append(residual, 0.0))
        except SingularError:
            return Correction(
                point, residual, linearised, Outcome.SINGULAR, tuple(sizes)
            )
        for halving in range(10):
            trial = point - step / 2**halving
            tried, derivative = system(trial)
            if _size(tried) < sizes[-1]:
                break
        else:
            return Correction(
                point, residual, linearised, Outcome.STALLED, tuple(sizes)
            )
        point, residual, linearised = trial, tried, derivative
        sizes.append(_size(residual))


def _size(residual: Array) -> float:
    return float(np.abs(residual).max(initial=0.0))
