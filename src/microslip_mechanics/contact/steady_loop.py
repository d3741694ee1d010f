"""The traction of friction that remembers, over a period that repeats itself (§6)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import Press, pressed, traction
from microslip_mechanics.contact.points import ContactPoints
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


@kernel
def steady_loop(
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
    by, slide, new = np.zeros((2, 10)), np.zeros(2), np.zeros(2)
    for place in range(samples):
        begins = first and place == 0
        before = place - 1 if place > 0 else samples - 1
        last = place if begins else before
        for axis in range(1, 3):
            slide[axis - 1] = displacement[axis, place] - displacement[axis, last]
        press, past, by_load = _ends(points, point, displacement, velocity, place, last)
        speed = 0.5 * (velocity[1:, place] + velocity[1:, last])
        traction(points, point, slide, speed, press, past, state[0], new, by)
        one, two = state[1]
        for axis in range(2):
            state[0, axis] = made[axis, place] = new[axis]
            state[1, axis] = change[axis, place] = (
                by[axis, 2] * speed[0] + by[axis, 3] * speed[1]
                + by[axis, 4] * by_load[0, 1] * velocity[0, place]
                + by[axis, 5] * by_load[1, 1] * velocity[0, last]
                + by[axis, 6] * one + by[axis, 7] * two
            )  # fmt: skip
        if gradient.size > 0:
            _carry(
                gradient, waves, frequency, axes, by, by_load, place, before, begins
            )  # fmt: skip


@kernel
def _ends(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    last: int,
) -> tuple[Press, Press, Array]:
    """Return how a point is pressed after and before a slide, and how loads change.

    The latter are the derivatives by depth and approach at both ends, shape ``(2, 2)``.
    """
    by = np.empty((2, 2))
    press, by[0, 0], by[0, 1] = pressed(
        points, point, displacement[0, place], velocity[0, place]
    )
    past, by[1, 0], by[1, 1] = pressed(
        points, point, displacement[0, last], velocity[0, last]
    )
    return press, past, by


@kernel
def _carry(
    gradient: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    by: Array,
    by_load: Array,
    place: int,
    before: int,
    begins: bool,
) -> None:
    """Write the derivatives at one sample from those at the sample before."""
    value, slope = waves
    last = place if begins else before
    for column in range(3):
        if not axes[column]:
            continue
        for term in range(value.shape[1]):
            wave, rate = value[place, term], frequency * slope[place, term]
            known, turned = value[last, term], frequency * slope[last, term]
            load = by_load[0, 0] * wave + by_load[0, 1] * rate
            past_load = by_load[1, 0] * known + by_load[1, 1] * turned
            slid, rate = wave - known, 0.5 * (rate + turned)
            one = gradient[0, column, before, term]
            two = gradient[1, column, before, term]
            for row in range(2):
                change = by[row, 6] * one + by[row, 7] * two
                if column == 0:
                    change += by[row, 4] * load + by[row, 5] * past_load
                    change += by[row, 8] * wave + by[row, 9] * known
                else:
                    change += by[row, column - 1] * slid + by[row, column + 1] * rate
                gradient[row, column, place, term] = change
