"""Friction that remembers, marched to its steady loop over one period (theory §6.5).

The loop begins with the traction that a stuck slider in the middle of its motion has,
k_t (w − w̄) with the mean w̄ over the period: where nothing slides that is the rule
which fixes the slider's free position, and no mean force is carried. Periods are
marched until the traction returns to itself; its derivatives go along, by the 2H + 1
coefficients of each direction in which the point itself moves.
"""

from __future__ import annotations

import itertools
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import FourierBasis, derivative, waves
from hbm.forces.sliding_loop import sliding_loop
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import PUSHED, ContactPoints
from microslip_mechanics.contact.steady_loop import Waves, steady_loop
from microslip_mechanics.jit import kernel


def marched(points: ContactPoints) -> NDArray[np.bool_]:
    """Return which points have friction that is marched to a steady loop, (points,)."""
    which: NDArray[np.bool_] = remembers(points) | (points.friction == PUSHED)
    return which


class FrictionMemory:
    """Tractions of the points that are marched, and their derivatives."""

    def __init__(self, basis: Array, fourier: FourierBasis) -> None:
        """Plan for ``basis``, the map from y to the points, ``(3 points, rank)``."""
        self._basis, self._fourier = basis, fourier

    def add(
        self,
        points: ContactPoints,
        moved: tuple[Array, Array],
        frequency: float,
        force: Array,
        change: Array,
    ) -> None:
        """Add tractions and (∂traction/∂ω) ω to rows of shape (3 points, samples).

        ``moved`` are displacement and velocity of the points at all samples.
        """
        none, terms = np.zeros((2, 3, 0, 0)), Waves(*np.zeros((2, 0, 0)))
        for point in np.flatnonzero(marched(points)).tolist():
            rows = slice(3 * point, 3 * point + 3)
            loop = sliding_loop if points.friction[point] == PUSHED else steady_loop
            made, by_frequency = loop(
                points, point, moved[0][rows], moved[1][rows], terms, frequency,
                self._axes(point), none,
            )  # fmt: skip
            force[3 * point + 1 : 3 * point + 3] += made
            change[3 * point + 1 : 3 * point + 3] += by_frequency

    def add_jacobian(
        self,
        points: ContactPoints,
        moved: tuple[Array, Array],
        frequency: float,
        places: NDArray[np.int64],
        jacobian: Array,
    ) -> None:
        """Add ∂traction/∂y to a Jacobian.

        ``places``, shape ``(2H + 1, rank)``, are the rows and columns of the
        coefficients; negative ones are left out.
        """
        terms, analysis = self._series
        gradient = np.empty((2, 3, *terms.value.shape))
        for point in np.flatnonzero(marched(points)).tolist():
            rows, axes = slice(3 * point, 3 * point + 3), self._axes(point)
            loop = sliding_loop if points.friction[point] == PUSHED else steady_loop
            loop(
                points, point, moved[0][rows], moved[1][rows], terms, frequency,
                axes, gradient,
            )  # fmt: skip
            for row, column in itertools.product((1, 2), range(3)):
                if axes[row] and axes[column]:
                    block = analysis @ gradient[row - 1, column]
                    left, right = (
                        self._basis[3 * point + row],
                        self._basis[rows][column],
                    )
                    _scatter(block, left, right, places, jacobian)

    @cached_property
    def _series(self) -> tuple[Waves, Array]:
        """Return the terms at the samples, and the analysis; for derivatives alone."""
        there, analysis = waves(self._fourier.harmonics, self._fourier.samples)
        slope = -derivative(there)  # of the terms, not of coefficients
        return Waves(*map(np.ascontiguousarray, (there.T, slope.T))), analysis

    def _axes(self, point: int) -> NDArray[np.bool_]:
        """Return along which directions a point moves, shape (3,)."""
        rows = self._basis[3 * point : 3 * point + 3]
        moves: NDArray[np.bool_] = (rows != 0.0).any(axis=1)
        return moves


@kernel
def _scatter(
    block: Array,
    left: Array,
    right: Array,
    places: NDArray[np.int64],
    jacobian: Array,
) -> None:
    """Add the derivatives of one traction by one direction, brought to y."""
    for a in np.flatnonzero(left):
        for b in np.flatnonzero(right):
            factor = left[a] * right[b]
            for j in range(block.shape[0]):
                if places[j, a] < 0:
                    continue
                for k in range(block.shape[1]):
                    if places[k, b] >= 0:
                        jacobian[places[j, a], places[k, b]] += factor * block[j, k]
