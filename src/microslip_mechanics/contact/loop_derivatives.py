"""Derivatives of friction that remembers, over a period that repeats itself (§6)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.loop_step import Motion, Step, before, take
from microslip_mechanics.jit import bare_kernel, kernel

FORGOTTEN = 1e-18
"""share of a derivative at the beginning of a period that counts as none"""


class Waves(NamedTuple):
    """Fourier terms at the samples, each of shape (samples, 2H + 1)."""

    value: Array
    slope: Array
    """derivative by the phase"""


@kernel
def differentiate(
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

    Parameters
    ----------
    motion, waves, frequency, axes
        As :func:`~microslip_mechanics.contact.steady_loop.steady_loop` has them.
    sweeps
        Periods that led to the steady loop.
    state
        Traction and its change where the loop begins, shape ``(2, 2)``; carried on.
    step
        Overwritten.
    gradient
        Written, shape ``(2, 3, samples, 2H + 1)``.
    """
    samples, terms = waves.value.shape
    kept = np.zeros((samples + 1, 2, 2))  # Φ up to each sample
    kept[-1, 0, 0] = kept[-1, 1, 1] = 1.0
    gradient[:, :, -1] = 0.0
    for place in range(samples):
        take(motion, place, False, state, step)
        last = before(place, samples)
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
