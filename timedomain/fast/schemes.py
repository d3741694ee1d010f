"""One-step schemes of the fast march, as tables (theory, §7.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Scheme:
    """Diagonally implicit Runge–Kutta scheme whose last stage is the end of the step.

    Stage 0 is the begin of the step. A scheme of ``mean`` forces does not discretise
    the structure but the forces on it: loads are linear in time over the step, contact
    forces constant, those of the mean displacement and the mean velocity of the step.
    """

    name: str
    matrix: Array
    """weights of the stages' rates, shape (stages + 1, stages + 1)"""
    work: Array
    """weights of the quadrature of powers, shape (stages + 1,)"""
    other: Array
    """weights of the embedded solution, shape (stages + 1,)"""
    mean: bool = False

    @property
    def times(self) -> Array:
        """Times of the stages over the step, shape (stages + 1,)."""
        times: Array = self.matrix.sum(axis=1)
        return times

    @property
    def stages(self) -> int:
        """Number of implicit stages."""
        return len(self.matrix) - 1


def _sdirk2() -> Scheme:
    """Return Alexander's L-stable scheme of second order (1977)."""
    diagonal = 1.0 - math.sqrt(0.5)
    matrix = np.array([[0.0, 0.0, 0.0], [0.0, diagonal, 0.0], [0.0, 1 - diagonal, 0]])
    matrix[2, 2] = diagonal
    return Scheme("SDIRK2", matrix, matrix[2], np.array([0.0, 1.0, 0.0]))


SDIRK2 = _sdirk2()
MEAN_FORCE = Scheme(
    "mean force",
    np.array([[0.0, 0.0], [0.5, 0.5]]),
    np.array([0.0, 1.0]),
    np.array([1.0, 0.0]),
    mean=True,
)
