"""Rigid friction over a period that repeats itself: a mass under a push (§6.5)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.loop_gradient import Waves
from microslip_mechanics.contact.memory import friction_load
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.rigid import slide
from microslip_mechanics.jit import bare_kernel, kernel

TRIALS = 50
"""of the momentum with which a period begins and ends"""
STEADY = 1e-13
"""change of it over a period, over the largest push"""


class Step(NamedTuple):
    """One step of the mass, by both tangents."""

    push: Array
    """shape (2,)"""
    old: Array
    """momentum before it, shape (2,)"""
    made: Array
    """mean traction (2) and momentum after it (2)"""
    by: Array
    """their derivatives by push (2), limit (1), momentum before (2) and loss (1)"""


@kernel
def sliding_loop(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    gradient: Array,
) -> tuple[Array, Array]:
    """Return minus the traction of the steady loop, and (∂/∂ω) ω of it, (2, samples).

    Arguments are those of :func:`~microslip_mechanics.contact.steady_loop.steady_loop`,
    but displacements along the tangents are pushes over k_t, and ``gradient``, shape
    ``(2, 3, samples, 2H + 1)``, is written with the derivatives as a whole.
    """
    samples = displacement.shape[1]
    loss = points.stribeck[point] * math.pi / (frequency * samples)
    made, change = np.zeros((2, 2, samples))
    step = Step(np.zeros(2), np.zeros(2), np.zeros(4), np.zeros((4, 6)))
    start, steady = _begun(points, point, displacement, velocity, loss, step)
    columns = np.zeros((2, 1 + gradient.shape[1] * gradient.shape[3]))
    for repeated in range(2):
        _hand_over(start, step.old)
        for place in range(samples):
            by_depth, by_approach = _step(
                points, point, displacement, velocity, loss, place, step
            )
            by_rate = by_approach * velocity[0, place]
            for axis in range(2):
                made[axis, place] = -step.made[axis]
            one, two = columns[0, 0], columns[1, 0]
            for row in range(4):
                by = step.by[row]
                varied = points.dynamic[point] * by[2] * by_rate - by[5] * loss
                varied += by[3] * one + by[4] * two
                if row < 2:
                    change[row, place] = -varied
                else:
                    columns[row - 2, 0] = varied
            if gradient.size > 0:
                _carry(
                    gradient, columns, waves, frequency, axes, step,
                    points.tangential[point], points.dynamic[point] * by_depth,
                    points.dynamic[point] * by_approach, place,
                )  # fmt: skip
            _hand_over(step.made[2:], step.old)
        if repeated == 0:
            np.dot(steady.copy(), columns.copy(), columns)
    return made, change


@kernel
def _begun(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    loss: float,
    step: Step,
) -> tuple[Array, Array]:
    """Return the momentum that a period repeats, and (1 − Φ)⁻¹ of its map Φ."""
    start, largest = np.zeros(2), TINY
    steady: Array = np.eye(2)
    for _ in range(TRIALS):
        _hand_over(start, step.old)
        carried = np.eye(2)
        for place in range(displacement.shape[1]):
            _step(points, point, displacement, velocity, loss, place, step)
            _hand_over(step.made[2:], step.old)
            carried = np.dot(step.by[2:, 3:5].copy(), carried)
            largest = max(largest, abs(step.push[0]), abs(step.push[1]))
            largest = max(largest, abs(step.old[0]), abs(step.old[1]))
        steady = np.linalg.inv(np.eye(2) - carried)
        gap = step.old - start
        if np.abs(gap).max() <= STEADY * largest:
            break
        start = start + np.dot(steady, gap)
    return start, steady


@bare_kernel
def _hand_over(made: Array, old: Array) -> None:
    """Write the momentum with which the next step begins."""
    for axis in range(2):
        old[axis] = made[axis]


@bare_kernel
def _step(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    loss: float,
    place: int,
    step: Step,
) -> tuple[float, float]:
    """Take the step around one sample; return the load's derivatives."""
    load, by_depth, by_approach = friction_load(
        points, point, displacement[0, place], velocity[0, place]
    )
    limit = points.dynamic[point] * load
    for axis in range(2):
        step.push[axis] = points.tangential[point] * displacement[axis + 1, place]
    slide(step.push, limit, loss, step.old, step.made, step.by)
    return by_depth, by_approach


@bare_kernel
def _carry(
    gradient: Array,
    columns: Array,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    step: Step,
    scale: float,
    by_depth: float,
    by_approach: float,
    place: int,
) -> None:
    """Write the derivatives of the traction at one sample, and carry the momentum's.

    ``columns``, shape ``(2, 1 + 3 terms)``, holds those of the momentum, behind the one
    by the loss.
    """
    value, slope = waves
    terms = value.shape[1]
    for column in range(3):
        if not axes[column]:
            continue
        for term in range(terms):
            wave = value[place, term]
            limit = by_depth * wave + by_approach * frequency * slope[place, term]
            at = 1 + column * terms + term
            one, two = columns[0, at], columns[1, at]
            for row in range(4):
                by = step.by[row]
                varied = by[3] * one + by[4] * two
                if column == 0:
                    varied += by[2] * limit
                else:
                    varied += by[column - 1] * scale * wave
                if row < 2:
                    gradient[row, column, place, term] = -varied
                else:
                    columns[row - 2, at] = varied
