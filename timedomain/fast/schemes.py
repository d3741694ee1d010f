"""One-step schemes of the fast march, as tables (theory, §7.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Scheme:
    """Diagonally implicit Runge–Kutta scheme whose last stage is the end of the step.

    Stage 0 is the begin of the step. An ``exact`` scheme does not discretise the
    structure but the forces on it: loads are linear in time over the step, contact
    forces linear too, or with ``mean`` constant: those of the mean displacement and the
    mean velocity of the step.
    """

    name: str
    matrix: Array
    """weights of the stages' rates, shape (stages + 1, stages + 1)"""
    work: Array
    """weights of the quadrature of powers, shape (stages + 1,)"""
    other: Array
    """weights of the embedded solution, shape (stages + 1,)"""
    exact: bool = False
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


def runge_kutta(name: str, rows: list[list[float]], other: Array) -> Scheme:
    """Return a scheme from its stages' weights, whose powers are integrated exactly."""
    matrix = np.zeros((len(rows), len(rows)))
    for place, row in enumerate(rows):
        matrix[place, : len(row)] = row
    return Scheme(name, matrix, _quadrature(matrix.sum(axis=1)), other)


def _quadrature(times: Array) -> Array:
    """Return the weights that integrate polynomials through the stages exactly."""
    powers = np.arange(len(times))
    weights: Array = np.linalg.solve(times[None] ** powers[:, None], 1 / (powers + 1.0))
    return weights


def _sdirk2() -> Scheme:
    """Return Alexander's L-stable scheme of second order (1977)."""
    diagonal = 1.0 - math.sqrt(0.5)
    matrix = np.array([[0.0, 0.0, 0.0], [0.0, diagonal, 0.0], [0.0, 1 - diagonal, 0]])
    matrix[2, 2] = diagonal
    return Scheme("SDIRK2", matrix, matrix[2], np.array([0.0, 1.0, 0.0]))


SDIRK2 = _sdirk2()
TRAPEZOID = runge_kutta(
    "average acceleration", [[0.0], [0.5, 0.5]], np.array([1.0, 0.0])
)
MEAN_FORCE = Scheme(
    "mean force",
    TRAPEZOID.matrix,
    np.array([0.0, 1.0]),
    TRAPEZOID.other,
    exact=True,
    mean=True,
)
