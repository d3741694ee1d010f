"""The traction of friction that remembers, over a period that repeats itself (§6.5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.closed_gradient import close_gradient, last_gradient
from microslip_mechanics.contact.forgetting import even, further, go_on, keep
from microslip_mechanics.contact.loop_gradient import (
    LoopGradient,
    Step,
    Waves,
    begin_gradient,
    carry_gradient,
)
from microslip_mechanics.contact.memory import pressed, traction
from microslip_mechanics.contact.points import BRISTLE, ContactPoints
from microslip_mechanics.jit import bare_kernel, kernel

PERIODS, FEW = 200, 20
"""most that are marched; the second of bristles, which forget evenly, or hardly"""
STEADY = 1e-12
"""change of the traction over a period, over its largest value"""


class Motion(NamedTuple):
    """Of one contact point, at all samples of a period."""

    points: ContactPoints
    point: int
    displacement: Array
    """normal and tangents [m], shape (3, samples)"""
    velocity: Array
    """shape (3, samples)"""


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
    gradient: LoopGradient,
) -> tuple[Array, Array]:
    """Return traction and (∂traction/∂ω) ω of the steady loop, each (2, samples).

    ``lean`` is by how much the slider is bent in the middle of its motion [m], shape
    ``(3,)``. ``gradient`` is written with the derivatives by the coefficients of
    normal and tangents, unless it is empty: of and by those along which the point
    moves, as ``axes`` says. A mean along the tangents changes nothing: in its place
    are those by ``lean``.
    """
    motion = Motion(points, point, displacement, velocity)
    samples = displacement.shape[1]
    made, change = np.zeros((2, 2, samples))
    by, by_load = np.zeros((2, 10)), np.zeros((2, 2))
    step = Step(np.zeros(2), np.zeros(2), np.zeros(2), by, by_load)
    state = np.zeros((2, 2))  # traction and its change so far
    past, kept, more = np.full(2, np.inf), np.zeros((2, 2)), np.zeros((2, 2))
    _begin(motion, lean, state)
    asked, run = gradient.run.size > 0, 0
    if asked:
        begin_gradient(gradient, waves, points.tangential[point])
    closed = False
    for sweep in range(FEW if points.friction[point] == BRISTLE else PERIODS):
        first, before = state.copy(), last_gradient(gradient, waves, axes, run)
        if asked:
            gradient.rest[0] = gradient.rest[run]
        run = _around(
            motion, sweep == 0, state, step, made, change, gradient, waves, frequency,
            axes, kept,
        )  # fmt: skip
        largest, moved = max(np.abs(made).max(), TINY), state - first
        steady = sweep > 0 and np.abs(moved[0]).max() <= STEADY * largest
        known = steady or points.friction[point] == BRISTLE
        known = sweep > 0 and (known or even(kept, past, moved[0]))
        goes_on = further(kept, known, more)
        if steady and (closed or not goes_on):
            break
        go_on(more, goes_on, moved, state, past)
        close_gradient(gradient, waves, axes, run, before, more)
        closed = steady
    return made, change


@bare_kernel
def _around(
    motion: Motion,
    begins: bool,
    state: Array,
    step: Step,
    made: Array,
    change: Array,
    gradient: LoopGradient,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    kept: Array,
) -> int:
    """March a period; return the last run.

    ``kept`` is written with what is left of the traction before, along the tangents
    along which the point moves, shape ``(2, 2)``.
    """
    run, samples = 0, made.shape[1]
    kept[:] = 0.0
    for axis in range(2):
        kept[axis, axis] = 1.0 if axes[axis + 1] else 0.0
    for place in range(samples):
        last = _last(place, samples, begins)
        _take(motion, place, last, state, step)
        keep(step.by, axes, kept)
        if gradient.run.size > 0:
            run = carry_gradient(
                gradient, waves, frequency, axes, step, place, last, run
            )
            gradient.run[place] = run
        for axis in range(2):
            made[axis, place], change[axis, place] = state[0, axis], state[1, axis]
    return run


@bare_kernel
def _begin(motion: Motion, lean: Array, state: Array) -> None:
    """Write what a spring carries that sticks in the middle of its motion."""
    stiffness = motion.points.tangential[motion.point]
    for axis in range(2):
        path = motion.displacement[axis + 1]
        state[0, axis] = stiffness * (path[0] - path.mean() + lean[axis + 1])


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
