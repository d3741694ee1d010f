"""The traction of friction that remembers, over a period that repeats itself (§6)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import pressed, traction
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel, kernel

PERIODS = 20
"""most that are marched"""
STEADY = 1e-12
"""change of the traction over a period, over its largest value"""
FORGOTTEN = 1e-18
"""share of a derivative at the beginning of a period that counts as none"""


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
            _take(motion, place, sweep == 0 and place == 0, state, step)
            for axis in range(2):
                made[axis, place], change[axis, place] = state[0, axis], state[1, axis]
        sweeps += 1
        largest = max(np.abs(made).max(), 1e-300)
        if sweep > 0 and np.abs(state[0] - first).max() <= STEADY * largest:
            break
    if gradient.size > 0:
        _differentiate(motion, waves, frequency, axes, sweeps, state, step, gradient)
    return made, change


@bare_kernel
def _take(motion: Motion, place: int, begins: bool, state: Array, step: Step) -> None:
    """Slide to a sample from the one before, or begin there: traction and change."""
    points, point, displacement, velocity = motion
    last = _before(place, displacement.shape[1])
    if begins:
        last = place
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
def _before(place: int, samples: int) -> int:
    """Return the sample before one, around the period."""
    return place - 1 if place > 0 else samples - 1


@kernel
def _differentiate(
    motion: Motion,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    sweeps: int,
    state: Array,
    step: Step,
    gradient: Array,
) -> None:
    """Write the derivatives along one more period, which repeats itself.

    It makes Φ g + b of derivatives g at its beginning. They begin as those of a spring
    that sticks in the middle of its motion, and go through as many periods as the
    traction did.
    """
    samples, terms = waves.value.shape
    kept = np.zeros((samples + 1, 2, 2))  # Φ up to each sample
    kept[-1, 0, 0] = kept[-1, 1, 1] = 1.0
    gradient[:, :, -1] = 0.0
    for place in range(samples):
        _take(motion, place, False, state, step)
        last = _before(place, samples)
        _carry(gradient, waves, frequency, axes, step, place, last)
        _keep(kept, step.by, place)
    begun: Array = np.zeros((2, 3, terms))
    for axis in range(2):
        stiffness = motion.points.tangential[motion.point]
        for term in range(1, terms):
            begun[axis, axis + 1, term] = stiffness * waves.value[-1, term]
    for _ in range(sweeps):
        reached = gradient[:, :, -1].copy()
        _add_begun(reached, kept[samples - 1], begun)
        begun = reached
    for place in range(samples):
        if _forgotten(kept[place]):
            break
        _add_begun(gradient[:, :, place], kept[place], begun)


@bare_kernel
def _add_begun(gradient: Array, kept: Array, begun: Array) -> None:
    """Add what is left of derivatives at the beginning, each (2, 3, terms)."""
    for row in range(gradient.shape[0]):
        for column in range(gradient.shape[1]):
            target = gradient[row, column]
            one, two = begun[0, column], begun[1, column]
            for term in range(target.size):
                target[term] += kept[row, 0] * one[term] + kept[row, 1] * two[term]


@bare_kernel
def _forgotten(kept: Array) -> bool:
    """Return whether nothing counts that was before."""
    largest = 0.0
    for row in range(kept.shape[0]):
        for column in range(kept.shape[1]):
            largest = max(largest, abs(kept[row, column]))
    return largest < FORGOTTEN


@bare_kernel
def _keep(kept: Array, by: Array, place: int) -> None:
    """Write Φ up to a sample from that up to the sample before; 1 is the last."""
    for row in range(2):
        for column in range(2):
            kept[place, row, column] = (
                by[row, 6] * kept[place - 1, 0, column]
                + by[row, 7] * kept[place - 1, 1, column]
            )


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
    """Write the derivatives at one sample from those at the sample before."""
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
            own, across = gradient[row, column, last], gradient[other, column, last]
            waves_now, waves_past = value[place], value[last]
            rates_now, rates_past = slope[place], slope[last]
            alone = by[row, 6 + row]
            for term in range(target.size):
                target[term] = (
                    alone * own[term] + share * across[term]
                    + now * waves_now[term] + past * waves_past[term]
                    + rate * rates_now[term] + turned * rates_past[term]
                )  # fmt: skip
