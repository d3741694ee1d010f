"""Newton corrector on a bordered system; knows no physics."""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array

System: TypeAlias = Callable[[Array], tuple[Array, Array]]
"""point (n + 1,) ↦ residual (n,) and Jacobian (n, n + 1)"""


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
    jacobian: Array
    outcome: Outcome
    residuals: tuple[float, ...]
    """largest residual before the first and after each iteration"""

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
    A step that raises the residual is halved, five times at the most.
    """
    point = predicted
    residual, jacobian = system(point)
    sizes = [_size(residual)]
    while True:
        if not np.isfinite(sizes[-1]):
            return Correction(point, jacobian, Outcome.OVERFLOW, tuple(sizes))
        if sizes[-1] <= tolerance:
            return Correction(point, jacobian, Outcome.CONVERGED, tuple(sizes))
        if len(sizes) > max_iterations:
            return Correction(point, jacobian, Outcome.EXHAUSTED, tuple(sizes))
        try:
            step = np.linalg.solve(
                np.vstack([jacobian, normal]), np.append(residual, 0.0)
            )
        except np.linalg.LinAlgError:
            return Correction(point, jacobian, Outcome.SINGULAR, tuple(sizes))
        for halving in range(6):
            trial = point - step / 2**halving
            residual, jacobian = system(trial)
            if _size(residual) < sizes[-1]:
                break
        else:
            return Correction(point, jacobian, Outcome.STALLED, tuple(sizes))
        point = trial
        sizes.append(_size(residual))


def _size(residual: Array) -> float:
    return float(np.abs(residual).max(initial=0.0))
