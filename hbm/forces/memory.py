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
from collections.abc import Callable
from functools import cached_property, partial
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import FourierBasis, derivative, waves
from hbm.forces.multiplied import multiplied
from hbm.forces.sliding_loop import sliding_loop
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.contact.loop_gradient import (
    LoopGradient,
    Waves,
    loop_gradient,
)
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import PUSHED, ContactPoints
from microslip_mechanics.contact.steady_loop import steady_loop
from microslip_mechanics.jit import kernel

NOTHING = Waves(*np.zeros((2, 0, 0)))
"""terms by which no derivatives are taken"""
Blocks: TypeAlias = Callable[[int, int], Array]
"""traction, direction ↦ derivatives by coefficients, shape (2H + 1, 2H + 1)"""


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
        leans = self._leans(moved[0])
        for point in np.flatnonzero(marched(points)).tolist():
            made, by_frequency, _ = self._loop(
                points, point, moved, NOTHING, frequency, leans[point]
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
        (terms, _), leans = self._series, self._leans(moved[0])
        for point in np.flatnonzero(marched(points)).tolist():
            axes = self._axes(point)
            *_, blocks = self._loop(
                points, point, moved, terms, frequency, leans[point]
            )
            rows = slice(3 * point, 3 * point + 3)
            seen, mean = self._basis[rows], self._basis[rows].copy()
            if points.friction[point] != PUSHED:
                mean[1:] = self._leaning[rows][1:]
            for row, column in itertools.product((1, 2), range(3)):
                if axes[row] and axes[column]:
                    block = blocks(row - 1, column)
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
    ) -> tuple[Array, Array, Blocks]:
        """Return what a point's loop adds to the force, (∂/∂ω) ω of it, and blocks.

        These are coefficients of one traction by those of one direction in ``terms``.
        """
        rows, axes = slice(3 * point, 3 * point + 3), self._axes(point)
        motion = points, point, moved[0][rows], moved[1][rows], terms, frequency, axes
        shape = moved[0].shape[1], terms.value.shape[1]
        if points.friction[point] == PUSHED:
            every = np.empty((2, 3, *shape))
            made, change = sliding_loop(*motion, every)
            return made, change, lambda *which: self._series[1] @ every[which]
        parts = loop_gradient(*shape)
        made, change = steady_loop(*motion, lean, parts)
        return made, change, partial(self._block, parts)

    def _block(self, parts: LoopGradient, row: int, column: int) -> Array:
        """Return coefficients of a traction by those of a direction, from the parts."""
        _, analysis = self._series
        runs, first = np.unique(parts.run, return_index=True)
        before = np.add.reduceat(analysis, first, axis=1)
        now, rate = parts.now[row, column], parts.rate[row, column]
        made = multiplied(now, rate, self._fourier.harmonics)
        block: Array = made + before @ parts.rest[runs, row, column]
        return block

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
