"""Derivatives of a loop that forgets slowly, once it has closed (theory §6.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.loop_gradient import LoopGradient, Waves
from microslip_mechanics.jit import kernel


@kernel
def last_gradient(
    gradient: LoopGradient, waves: Waves, axes: NDArray[np.bool_], run: int
) -> Array:
    """Return the derivatives at the last sample, shape (2, 3, terms)."""
    found = np.zeros(gradient.rest.shape[1:])
    for row in range(2):
        for column in range(3):
            if axes[row + 1] and axes[column] and gradient.run.size > 0:
                now = gradient.now[row, column, -1]
                rate = gradient.rate[row, column, -1]
                rest = gradient.rest[run, row, column]
                found[row, column] = (
                    now * waves.value[-1] + rate * waves.slope[-1] + rest
                )
    return found


@kernel
def close_gradient(
    gradient: LoopGradient,
    waves: Waves,
    axes: NDArray[np.bool_],
    run: int,
    before: Array,
    more: Array,
) -> None:
    """Add to the derivatives at the last sample what further periods do.

    They have changed since ``before``, a period ago, and will by ``more``, shape
    ``(2, 2)``, times that.
    """
    changed = last_gradient(gradient, waves, axes, run) - before
    for row in range(2):
        for column in range(3):
            if axes[row + 1] and axes[column] and gradient.run.size > 0:
                gradient.rest[run, row, column] += (
                    more[row, 0] * changed[0, column]
                    + more[row, 1] * changed[1, column]
                )
