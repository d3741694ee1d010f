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
from functools import cached_property, lru_cache, partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import FourierBasis
from hbm.forces.loop_matrix import block, loop_waves, scatter
from hbm.forces.marched import marched
from hbm.forces.remembered import Loop, Remembered
from hbm.forces.sliding_loop import sliding_loop
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.contact.loop_gradient import (
    LoopGradient,
    Waves,
    loop_gradient,
)
from microslip_mechanics.contact.points import PUSHED, ContactPoints
from microslip_mechanics.contact.steady_loop import steady_loop

NOTHING = Waves(*np.zeros((2, 0, 0)))
"""terms by which no derivatives are taken"""


class _Marched(NamedTuple):
    """Contacts and how they move."""

    points: ContactPoints
    displacement: Array
    """at all samples [m], shape (3 points, samples)"""
    velocity: Array
    """the same [m/s]"""
    frequency: float
    """of the excitation [rad/s]"""
    leans: Array
    """by how much sliders are bent in the mean [m], shape (points, 3)"""

    @property
    def each(self) -> list[int]:
        """The points that are marched."""
        found: list[int] = np.flatnonzero(marched(self.points)).tolist()
        return found


class FrictionMemory:
    """Tractions of the points that are marched, and their derivatives."""

    def __init__(
        self, basis: Array, fourier: FourierBasis, floating: Floating | None
    ) -> None:
        """Plan for ``basis``, the map from y to the points, ``(3 points, rank)``."""
        self._basis, self._fourier, self.floating = basis, fourier, floating
        self._waves = lru_cache(maxsize=2)(partial(loop_waves, fourier.samples))

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
        motion = self._marched(points, moved, frequency)
        for point in motion.each:
            made, by_frequency, _ = self._loop(motion, point, NOTHING)
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

        ``places``, shape ``(2h + 1, rank)`` with h ≤ H, are the rows and columns of the
        coefficients; negative ones are left out.
        """
        series, analysis = self._waves(len(places) // 2)
        motion = self._marched(points, moved, frequency)
        for point in motion.each:
            axes, (seen, mean) = self._axes(point), self._maps(points, point)
            *_, gradient = self._loop(motion, point, series)
            for row, column in itertools.product((1, 2), range(3)):
                if axes[row] and axes[column]:
                    made = block(gradient, analysis, row - 1, column)
                    scatter(
                        made, seen[row], mean[column], seen[column], places, jacobian
                    )

    def remembered(
        self,
        points: ContactPoints,
        moved: tuple[Array, Array],
        frequency: float,
    ) -> Remembered:
        """Return what multiplies by ∂traction/∂y of the points that are not pushed."""
        series, _ = self._waves(self._fourier.harmonics)
        motion, loops = self._marched(points, moved, frequency), []
        for point in motion.each:
            *_, gradient = self._loop(motion, point, series)
            if isinstance(gradient, LoopGradient):
                loops.append(Loop(*self._maps(points, point), gradient))
        return Remembered(loops, frequency)

    def _marched(
        self, points: ContactPoints, moved: tuple[Array, Array], frequency: float
    ) -> _Marched:
        leans: Array = np.zeros((len(moved[0]) // 3, 3))
        if self.floating is not None:
            leans = self.floating.lean(moved[0].mean(axis=1))
        return _Marched(points, *moved, frequency, leans)

    def _loop(
        self, motion: _Marched, point: int, series: Waves
    ) -> tuple[Array, Array, LoopGradient | Array]:
        """Return what a point's loop adds to the force, (∂/∂ω) ω of it, derivatives.

        The last are by the coefficients of each direction in ``series``: in parts, or
        of what is pushed at all samples, shape ``(2, 3, samples, terms)``.
        """
        rows, axes = slice(3 * point, 3 * point + 3), self._axes(point)
        points, displacement, velocity, frequency, leans = motion
        seen = displacement[rows], velocity[rows], series, frequency, axes
        shape = displacement.shape[1], series.value.shape[1]
        if points.friction[point] == PUSHED:
            every = np.empty((2, 3, *shape))
            return *sliding_loop(points, point, *seen, every), every
        parts = loop_gradient(*shape)
        return *steady_loop(points, point, *seen, leans[point], parts), parts

    def _maps(self, points: ContactPoints, point: int) -> tuple[Array, Array]:
        """Return the maps from y to a point, and from its mean, (3, rank) each."""
        rows = slice(3 * point, 3 * point + 3)
        seen, mean = self._basis[rows], self._basis[rows].copy()
        if points.friction[point] != PUSHED:
            mean[1:] = self._leaning[rows][1:]
        return seen, mean

    @cached_property
    def _leaning(self) -> Array:
        """Return by how much sliders are bent by the mean of y, (3 points, rank)."""
        if self.floating is None:
            return np.zeros_like(self._basis)
        directions = self.floating.directions
        made: Array = directions @ (directions.T @ self._basis)
        return made

    def _axes(self, point: int) -> NDArray[np.bool_]:
        """Return along which directions a point moves, shape (3,)."""
        rows = self._basis[3 * point : 3 * point + 3]
        moves: NDArray[np.bool_] = (rows != 0.0).any(axis=1)
        return moves
