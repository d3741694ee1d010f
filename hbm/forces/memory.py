"""Friction that remembers, marched to its steady loop over one period (theory §6.5).

The loop begins with the traction that a stuck slider in the middle of its motion has,
k_t (w − w̄) with the mean w̄ over the period: where nothing slides that is the rule
which fixes the slider's free position, and no mean force is carried but by bodies that
nothing else holds (:mod:`microslip_mechanics.contact.floating`). Periods are marched
until the traction returns to itself; its derivatives go along, by the 2H + 1
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
from microslip_mechanics.contact.floating import Floating
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

    def __init__(
        self, basis: Array, fourier: FourierBasis, floating: Floating | None
    ) -> None:
        """Plan for ``basis``, the map from y to the points, ``(3 points, rank)``."""
        self._basis, self._fourier, self.floating = basis, fourier, floating

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
        leans = self._leans(moved[0])
        for point in np.flatnonzero(marched(points)).tolist():
            lean = leans[point]
            made, by_frequency = self._loop(
                points, point, moved, terms, frequency, lean, none
            )
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
        gradient, leans = np.empty((2, 3, *terms.value.shape)), self._leans(moved[0])
        for point in np.flatnonzero(marched(points)).tolist():
            axes, lean = self._axes(point), leans[point]
            self._loop(points, point, moved, terms, frequency, lean, gradient)
            rows = slice(3 * point, 3 * point + 3)
            seen, mean = self._basis[rows], self._basis[rows].copy()
            if points.friction[point] != PUSHED:
                mean[1:] = self._leaning[rows][1:]
            for row, column in itertools.product((1, 2), range(3)):
                if axes[row] and axes[column]:
                    block = analysis @ gradient[row - 1, column]
                    _scatter(
                        block, seen[row], mean[column], seen[column], places, jacobian
                    )

    def _loop(
        self,
        points: ContactPoints,
        point: int,
        moved: tuple[Array, Array],
        terms: Waves,
        frequency: float,
        lean: Array,
        gradient: Array,
    ) -> tuple[Array, Array]:
        """Return what a point's loop adds to the force, and (∂/∂ω) ω of it."""
        rows, axes = slice(3 * point, 3 * point + 3), self._axes(point)
        motion = points, point, moved[0][rows], moved[1][rows], terms, frequency, axes
        if points.friction[point] == PUSHED:
            return sliding_loop(*motion, gradient)
        return steady_loop(*motion, lean, gradient)

    def _leans(self, displacement: Array) -> Array:
        """Return by how much sliders are bent in the mean [m], (points, 3)."""
        if self.floating is None:
            return np.zeros((len(displacement) // 3, 3))
        return self.floating.lean(displacement.mean(axis=1))

    @cached_property
    def _leaning(self) -> Array:
        """Return the same by the mean of y, shape (3 points, rank)."""
        if self.floating is None:
            return np.zeros_like(self._basis)
        directions = self.floating.directions
        made: Array = directions @ (directions.T @ self._basis)
        return made

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
    mean: Array,
    right: Array,
    places: NDArray[np.int64],
    jacobian: Array,
) -> None:
    """Add the derivatives of one traction by one direction, brought to y.

    The first is by what the direction has as the ``mean``, shape (rank,).
    """
    for a in np.flatnonzero(left):
        for b in range(right.size):
            first = 0 if mean[b] != 0.0 else 1
            last = block.shape[1] if right[b] != 0.0 else 1
            for j in range(block.shape[0]):
                if places[j, a] < 0:
                    continue
                for k in range(first, last):
                    if places[k, b] >= 0:
                        factor = left[a] * (mean[b] if k == 0 else right[b])
                        jacobian[places[j, a], places[k, b]] += factor * block[j, k]
