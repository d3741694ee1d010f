"""The traction of friction that remembers, over a period that repeats itself (§6.5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.memory import pressed, traction
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel, kernel

PERIODS = 20
"""most that are marched"""
STEADY = 1e-12
"""change of the traction over a period, over its largest value"""


class Waves(NamedTuple):
    """Fourier terms at the samples, each of shape (samples, 2H + 1)."""

    value: Array
    slope: Array
    """derivative by the phase"""


class Motion(NamedTuple):
    """Of one contact point, at all samples of a period."""

    points: ContactPoints
    point: int
    displacement: Array
    """normal and tangents [m], shape (3, samples)"""
    velocity: Array
    """shape (3, samples)"""


class Step(NamedTuple):
    """What the slide from one sample to the next makes; overwritten by the next."""

    slide: Array
    """shape (2,)"""
    speed: Array
    """mean of both ends, shape (2,)"""
    new: Array
    """traction after it, shape (2,)"""
    by: Array
    """its derivatives, shape (2, 10)"""
    by_load: Array
    """those of the load after and before it by depth and approach, shape (2, 2)"""


@kernel
def steady_loop(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    lean: Array,
    gradient: Array,
) -> tuple[Array, Array]:
    """Return traction and (∂traction/∂ω) ω of the steady loop, each (2, samples).

    ``lean`` is by how much the slider is bent in the middle of its motion [m], shape
    ``(3,)``. ``gradient``, shape ``(2, 3, samples, 2H + 1)``, is written with the
    derivatives by the coefficients of normal and tangents, unless it is empty: of and
    by those along which the point moves, as ``axes`` says. A mean along the tangents
    changes nothing: in its place are those by ``lean``.
    """
    motion = Motion(points, point, displacement, velocity)
    samples = displacement.shape[1]
    made, change = np.zeros((2, 2, samples))
    by, by_load = np.zeros((2, 10)), np.zeros((2, 2))
    step = Step(np.zeros(2), np.zeros(2), np.zeros(2), by, by_load)
    state = np.zeros((2, 2))  # traction and its change so far
    _begin(motion, waves, lean, state, gradient)
    for sweep in range(PERIODS):
        first = state[0].copy()
        for place in range(samples):
            last = _last(place, samples, sweep == 0)
            _take(motion, place, last, state, step)
            if gradient.size > 0:
                _carry(gradient, waves, frequency, axes, step, place, last)
            for axis in range(2):
                made[axis, place], change[axis, place] = state[0, axis], state[1, axis]
        largest = max(np.abs(made).max(), TINY)
        if sweep > 0 and np.abs(state[0] - first).max() <= STEADY * largest:
            break
    return made, change


@bare_kernel
def _begin(
    motion: Motion, waves: Waves, lean: Array, state: Array, gradient: Array
) -> None:
    """Write what a spring carries that sticks in the middle of its motion."""
    stiffness = motion.points.tangential[motion.point]
    for axis in range(2):
        path = motion.displacement[axis + 1]
        state[0, axis] = stiffness * (path[0] - path.mean() + lean[axis + 1])
    if gradient.size > 0:
        gradient[:, :, -1] = 0.0
        for axis in range(2):
            for term in range(gradient.shape[3]):
                gradient[axis, axis + 1, -1, term] = stiffness * waves.value[0, term]


@bare_kernel
def _last(place: int, samples: int, first: bool) -> int:
    """Return the sample where a slide begins; the loop's first is none."""
    if place > 0 or first:
        return max(place - 1, 0)
    return samples - 1


@bare_kernel
def _take(motion: Motion, place: int, last: int, state: Array, step: Step) -> None:
    """Slide from one sample to another: traction and its change, shape (2, 2)."""
    points, point, displacement, velocity = motion
    by, by_load = step.by, step.by_load
    for axis in range(2):
        was, now = displacement[axis + 1, last], displacement[axis + 1, place]
        step.slide[axis] = now - was
        step.speed[axis] = 0.5 * (velocity[axis + 1, place] + velocity[axis + 1, last])
    press, by_load[0, 0], by_load[0, 1] = pressed(
        points, point, displacement[0, place], velocity[0, place]
    )
    past, by_load[1, 0], by_load[1, 1] = pressed(
        points, point, displacement[0, last], velocity[0, last]
    )
    traction(points, point, step.slide, step.speed, press, past, state[0], step.new, by)
    one, two = state[1, 0], state[1, 1]
    for axis in range(2):
        state[0, axis] = step.new[axis]
        state[1, axis] = (
            by[axis, 2] * step.speed[0] + by[axis, 3] * step.speed[1]
            + by[axis, 4] * by_load[0, 1] * velocity[0, place]
            + by[axis, 5] * by_load[1, 1] * velocity[0, last]
            + by[axis, 6] * one + by[axis, 7] * two
        )  # fmt: skip


@bare_kernel
def _carry(
    gradient: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    step: Step,
    place: int,
    last: int,
) -> None:
    """Write the derivatives at one sample from those at the sample before.

    The slide of ``step`` began at ``last``, which is ``place`` where a loop begins.
    """
    before = place - 1 if place > 0 else gradient.shape[2] - 1
    value, slope = waves
    by, by_load = step.by, step.by_load
    for row in range(gradient.shape[0]):
        for column in range(gradient.shape[1]):
            if not (axes[row + 1] and axes[column]):
                continue
            if column == 0:
                now = by[row, 4] * by_load[0, 0] + by[row, 8]
                past = by[row, 5] * by_load[1, 0] + by[row, 9]
                rate = by[row, 4] * by_load[0, 1] * frequency
                turned = by[row, 5] * by_load[1, 1] * frequency
            else:
                now, past = by[row, column - 1], -by[row, column - 1]
                rate = turned = 0.5 * frequency * by[row, column + 1]
            other, share = row, 0.0
            if axes[2 - row]:
                other, share = 1 - row, by[row, 7 - row]
            target = gradient[row, column, place]
            own, across = gradient[row, column, before], gradient[other, column, before]
            waves_now, waves_past = value[place], value[last]
            rates_now, rates_past = slope[place], slope[last]
            alone = by[row, 6 + row]
            for term in range(target.size):
                target[term] = (
                    alone * own[term] + share * across[term]
                    + now * waves_now[term] + past * waves_past[term]
                    + rate * rates_now[term] + turned * rates_past[term]
                )  # fmt: skip
