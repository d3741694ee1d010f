"""Derivatives of a steady loop of friction by Fourier coefficients, in parts (§6.5).

The derivative of the traction at one sample by the coefficients of one direction is

    now · (terms) + rate · (slopes of terms) + rest ,

with all that came before in ``rest``. That is the same at all samples of a stick, and
zero in a straight slide: few of them tell all of a loop.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel


class Waves(NamedTuple):
    """Fourier terms at the samples, each of shape (samples, 2H + 1)."""

    value: Array
    slope: Array
    """derivative by the phase"""


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


class LoopGradient(NamedTuple):
    """Derivatives of both tractions by normal and tangents; empty if not asked for."""

    now: Array
    """by the displacement at the same sample [N/m], shape (2, 3, samples)"""
    rate: Array
    """by its derivative by the phase [N/m], shape (2, 3, samples)"""
    rest: Array
    """by what came before, as far as there are runs, (samples + 1, 2, 3, 2H + 1)"""
    run: NDArray[np.int64]
    """which of these holds at a sample; runs are numbered in order, (samples,)"""


def loop_gradient(samples: int, terms: int) -> LoopGradient:
    """Return room for the derivatives by so many coefficients; none for no terms."""
    length = samples if terms else 0
    return LoopGradient(
        np.zeros((2, 3, length)),
        np.zeros((2, 3, length)),
        np.empty((samples + 1 if terms else 0, 2, 3, terms)),
        np.zeros(length, np.int64),
    )


@bare_kernel
def begin_gradient(gradient: LoopGradient, waves: Waves, stiffness: float) -> None:
    """Write the derivatives of what a spring carries before the first sample."""
    rest = gradient.rest[0]
    rest[:] = 0.0
    gradient.now[:, :, -1] = 0.0
    gradient.rate[:, :, -1] = 0.0
    for axis in range(2):
        for term in range(rest.shape[2]):
            rest[axis, axis + 1, term] = stiffness * waves.value[0, term]


@bare_kernel
def carry_gradient(
    gradient: LoopGradient,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    step: Step,
    place: int,
    last: int,
    run: int,
) -> int:
    """Write the derivatives at one sample from those before; return its run.

    The slide of ``step`` began at ``last``, which is ``place`` where a loop begins;
    ``run`` is that of the sample before.
    """
    before = place - 1 if place > 0 else gradient.run.size - 1
    changes = False
    for row in range(2):
        for column in range(3):
            if axes[row + 1] and axes[column] and not changes:
                parts = _parts(gradient, frequency, axes, step, before, row, column)
                changes = _changes(parts, gradient.rest[run, row, column])
    if changes:
        _carry(gradient, waves, frequency, axes, step, before, last, run)
    _now(gradient, frequency, step, place)
    return run + 1 if changes else run


@inner_kernel
def _carry(
    gradient: LoopGradient,
    waves: Waves,
    frequency: float,
    axes: NDArray[np.bool_],
    step: Step,
    before: int,
    last: int,
    run: int,
) -> None:
    """Write the ``rest`` of the next run."""
    value, slope = waves.value[last], waves.slope[last]
    for row in range(2):
        for column in range(3):
            if not (axes[row + 1] and axes[column]):
                continue
            alone, share, past, turned = _parts(
                gradient, frequency, axes, step, before, row, column
            )
            other = 1 - row if axes[2 - row] else row
            own = gradient.rest[run, row, column]
            across = gradient.rest[run, other, column]
            target = gradient.rest[run + 1, row, column]
            for term in range(own.size):
                target[term] = (
                    alone * own[term] + share * across[term]
                    + past * value[term] + turned * slope[term]
                )  # fmt: skip


@bare_kernel
def _parts(
    gradient: LoopGradient,
    frequency: float,
    axes: NDArray[np.bool_],
    step: Step,
    before: int,
    row: int,
    column: int,
) -> tuple[float, float, float, float]:
    """Return how ``rest`` goes on.

    That is by itself, by that of the other traction, and by displacement and slope at
    the sample before.
    """
    by, by_load, other, share = step.by, step.by_load, row, 0.0
    if axes[2 - row]:
        other, share = 1 - row, by[row, 7 - row]
    alone = by[row, 6 + row]
    if column == 0:
        past = by[row, 5] * by_load[1, 0] + by[row, 9]
        turned = by[row, 5] * by_load[1, 1] * frequency
    else:
        past = -by[row, column - 1]
        turned = 0.5 * frequency * by[row, column + 1]
    now, rate = gradient.now[:, column, before], gradient.rate[:, column, before]
    past += alone * now[row] + share * now[other]
    turned += alone * rate[row] + share * rate[other]
    return alone, share, past, turned


@inner_kernel
def _changes(parts: tuple[float, float, float, float], own: Array) -> bool:
    """Return whether ``rest`` becomes another one."""
    alone, share, past, turned = parts
    if share != 0.0 or past != 0.0 or turned != 0.0:
        return True
    if alone != 1.0:
        for term in range(own.size):
            if own[term] != 0.0:
                return True
    return False


@inner_kernel
def _now(gradient: LoopGradient, frequency: float, step: Step, place: int) -> None:
    """Write the derivatives by what is at the same sample."""
    now, rate, by, by_load = gradient.now, gradient.rate, step.by, step.by_load
    for row in range(2):
        now[row, 0, place] = by[row, 4] * by_load[0, 0] + by[row, 8]
        rate[row, 0, place] = by[row, 4] * by_load[0, 1] * frequency
        for column in range(1, 3):
            now[row, column, place] = by[row, column - 1]
            rate[row, column, place] = 0.5 * frequency * by[row, column + 1]
