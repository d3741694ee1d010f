"""The traction of friction that remembers, over a period that repeats itself (§6)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.loop_derivatives import Waves, differentiate
from microslip_mechanics.contact.loop_step import Motion, Step, take
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel

PERIODS = 20
"""most that are marched"""
STEADY = 1e-12
"""change of the traction over a period, over its largest value"""


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
    the coefficients of normal and tangents, unless it is empty: of and by those along
    which the point moves, as ``axes`` says.
    """
    motion = Motion(points, point, displacement, velocity)
    made, change = np.zeros((2, 2, displacement.shape[1]))
    by, by_load = np.zeros((2, 10)), np.zeros((2, 2))
    step = Step(np.zeros(2), np.zeros(2), np.zeros(2), by, by_load)
    state = np.zeros((2, 2))  # traction and its change so far
    for axis in range(2):
        path = displacement[axis + 1]
        state[0, axis] = points.tangential[point] * (path[0] - path.mean())
    sweeps = 0
    for sweep in range(PERIODS):
        first = state[0].copy()
        for place in range(made.shape[1]):
            take(motion, place, sweep == 0 and place == 0, state, step)
            for axis in range(2):
                made[axis, place], change[axis, place] = state[0, axis], state[1, axis]
        sweeps += 1
        largest = max(np.abs(made).max(), 1e-300)
        if sweep > 0 and np.abs(state[0] - first).max() <= STEADY * largest:
            break
    if gradient.size > 0:
        differentiate(motion, waves, frequency, axes, sweeps, state, step, gradient)
    return made, change
