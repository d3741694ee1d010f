"""Friction that remembers, marched to its steady loop over one period (theory §6).

The loop begins with the traction that a stuck slider in the middle of its motion has,
k_t (w − w̄) with the mean w̄ over the period: where nothing slides that is the rule
which fixes the slider's free position, and no mean force is carried. Periods are
marched until the traction returns to itself; its derivatives go along, by the 2H + 1
coefficients of each direction in which the point itself moves.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.fourier import FourierBasis
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import ContactPoints
from microslip_mechanics.contact.memory import friction_load, remembers, traction
from microslip_mechanics.jit import kernel

PERIODS = 20
"""most that are marched"""
STEADY = 1e-12
"""change of the traction over a period, over its largest value"""


class Waves(NamedTuple):
    """Fourier terms at the samples, each of shape (samples, 2H + 1)."""

    value: Array
    slope: Array
    """derivative by the phase"""


class FrictionMemory:
    """Tractions of the points that remember, and their derivatives."""

    def __init__(self, basis: Array, fourier: FourierBasis) -> None:
        """Plan for ``basis``, the map from y to the points, ``(3 points, rank)``."""
        self._basis = basis
        phase = 2.0 * np.pi * np.arange(fourier.samples) / fourier.samples
        orders = np.arange(1, fourier.harmonics + 1)
        angles = np.multiply.outer(phase, orders)
        value = np.ones((fourier.samples, fourier.coefficients))
        value[:, 1::2], value[:, 2::2] = np.cos(angles), np.sin(angles)
        slope = np.zeros_like(value)
        slope[:, 1::2], slope[:, 2::2] = (
            -orders * value[:, 2::2],
            orders * value[:, 1::2],
        )
        self._waves = Waves(value, slope)
        self._analysis = value.T * (2.0 / fourier.samples)
        self._analysis[0] /= 2.0

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
        none = np.zeros((2, 3, 0, 0))
        for point in np.flatnonzero(remembers(points)).tolist():
            rows = slice(3 * point, 3 * point + 3)
            made, by_frequency = _loop(
                points, point, moved[0][rows], moved[1][rows], self._waves, frequency,
                self._axes(point), none,
            )  # fmt: skip
            force[3 * point + 1 : 3 * point + 3] += made
            change[3 * point + 1 : 3 * point + 3] += by_frequency

    def jacobian(
        self, points: ContactPoints, moved: tuple[Array, Array], frequency: float
    ) -> Array:
        """Return ∂traction/∂y, shape (2H + 1, rank, 2H + 1, rank)."""
        count, rank = self._waves.value.shape[1], self._basis.shape[1]
        result = np.zeros((count, rank, count, rank))
        gradient = np.empty((2, 3, *self._waves.value.shape))
        for point in np.flatnonzero(remembers(points)).tolist():
            rows, axes = slice(3 * point, 3 * point + 3), self._axes(point)
            _loop(
                points, point, moved[0][rows], moved[1][rows], self._waves, frequency,
                axes, gradient,
            )  # fmt: skip
            self._gather(point, axes, gradient, result)
        return result

    def _axes(self, point: int) -> NDArray[np.bool_]:
        """Return along which directions a point moves, shape (3,)."""
        rows = self._basis[3 * point : 3 * point + 3]
        moves: NDArray[np.bool_] = (rows != 0.0).any(axis=1)
        return moves

    def _gather(
        self, point: int, axes: NDArray[np.bool_], gradient: Array, result: Array
    ) -> None:
        """Add the derivatives of one point, brought to y."""
        rows = self._basis[3 * point : 3 * point + 3]
        for row in (1, 2):
            for column in range(3):
                if not (axes[row] and axes[column]):
                    continue
                block = self._analysis @ gradient[row - 1, column]
                for a in np.flatnonzero(rows[row]):
                    for b in np.flatnonzero(rows[column]):
                        result[:, a, :, b] += rows[row, a] * rows[column, b] * block


@kernel
def _loop(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    gradient: Array,
) -> tuple[Array, Array]:
    """Return traction and (∂traction/∂ω) ω of the steady loop, each (2, samples).

    ``gradient``, shape ``(2, 3, samples, 2H + 1)``, is written with the derivatives by
    the coefficients of normal and tangents, unless it is empty.
    """
    made, change = np.zeros((2, 2, displacement.shape[1]))
    state = np.zeros((2, 2))  # traction and its change so far
    stiffness = points.tangential[point]
    for axis in range(2):
        path = displacement[axis + 1]
        state[0, axis] = stiffness * (path[0] - path.mean())
    if gradient.size > 0:
        gradient[:, :, -1] = 0.0
        for axis in range(2):
            gradient[axis, axis + 1, -1] = stiffness * waves.value[0]
            gradient[axis, axis + 1, -1, 0] = 0.0
    for sweep in range(PERIODS):
        first = state[0].copy()
        _period(
            points, point, displacement, velocity, waves, frequency, axes,
            sweep == 0, state, made, change, gradient,
        )  # fmt: skip
        largest = max(np.abs(made).max(), 1e-300)
        if sweep > 0 and np.abs(state[0] - first).max() <= STEADY * largest:
            break
    return made, change


@kernel
def _period(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    first: bool,
    state: Array,
    made: Array,
    change: Array,
    gradient: Array,
) -> None:
    """March one period from ``state``: traction and its change; the first from rest."""
    samples = displacement.shape[1]
    by, slide, new = np.zeros((2, 7)), np.zeros(2), np.zeros(2)
    for place in range(samples):
        begins = first and place == 0
        before = place - 1 if place > 0 else samples - 1
        last = place if begins else before
        for axis in range(1, 3):
            slide[axis - 1] = displacement[axis, place] - displacement[axis, last]
        load, by_depth, by_approach = friction_load(
            points, point, displacement[0, place], velocity[0, place]
        )
        speed = velocity[1:, place]
        traction(points, point, slide, speed, load, state[0], new, by)
        one, two = state[1]
        for axis in range(2):
            state[0, axis] = made[axis, place] = new[axis]
            state[1, axis] = change[axis, place] = (
                by[axis, 2] * speed[0] + by[axis, 3] * speed[1]
                + by[axis, 4] * by_approach * velocity[0, place]
                + by[axis, 5] * one + by[axis, 6] * two
            )  # fmt: skip
        if gradient.size > 0:
            _carry(
                gradient, waves, frequency, axes, by, by_depth, by_approach, place,
                before, begins,
            )  # fmt: skip


@kernel
def _carry(
    gradient: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    by: Array,
    by_depth: float,
    by_approach: float,
    place: int,
    before: int,
    begins: bool,
) -> None:
    """Write the derivatives at one sample from those at the sample before."""
    value, slope = waves
    for column in range(3):
        if not axes[column]:
            continue
        for term in range(value.shape[1]):
            wave, rate = value[place, term], frequency * slope[place, term]
            slid = 0.0 if begins else wave - value[before, term]
            one = gradient[0, column, before, term]
            two = gradient[1, column, before, term]
            for row in range(2):
                change = by[row, 5] * one + by[row, 6] * two
                if column == 0:
                    change += by[row, 4] * (by_depth * wave + by_approach * rate)
                else:
                    change += by[row, column - 1] * slid + by[row, column + 1] * rate
                gradient[row, column, place, term] = change
