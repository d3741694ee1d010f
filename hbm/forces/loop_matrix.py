"""Derivatives of a loop of friction that remembers, as a matrix (theory §6.5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import derivative, waves
from hbm.forces.multiplied import multiplied
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.loop_gradient import LoopGradient, Waves
from microslip_mechanics.jit import kernel


def loop_waves(samples: int, harmonics: int) -> tuple[Waves, Array]:
    """Return the waves at the samples, and the analysis; for derivatives alone."""
    there, analysis = waves(harmonics, samples)
    slope = -derivative(there)  # of the waves, not of coefficients
    return Waves(*map(np.ascontiguousarray, (there.T, slope.T))), analysis


def block(
    gradient: LoopGradient | Array, analysis: Array, row: int, column: int
) -> Array:
    """Return coefficients of a traction by those of a direction, (terms, terms)."""
    if not isinstance(gradient, LoopGradient):
        every: Array = analysis @ gradient[row, column]
        return every
    runs, first = np.unique(gradient.run, return_index=True)
    before = np.add.reduceat(analysis, first, axis=1)
    now, rate = gradient.now[row, column], gradient.rate[row, column]
    made = multiplied(now, rate, len(analysis) // 2)
    made += before @ gradient.rest[runs, row, column]
    return made


@kernel
def scatter(
    block: Array,
    left: Array,
    mean: Array,
    right: Array,
    places: NDArray[np.int64],
    jacobian: Array,
) -> None:
    """Add the derivatives of one traction by one direction, brought to y.

    The first is by what the direction has as the ``mean``, shape (rank,).
    """
    for a in np.flatnonzero(left):
        for b in range(right.size):
            first = 0 if mean[b] != 0.0 else 1
            last = block.shape[1] if right[b] != 0.0 else 1
            for j in range(block.shape[0]):
                if places[j, a] < 0:
                    continue
                for k in range(first, last):
                    if places[k, b] >= 0:
                        factor = left[a] * (mean[b] if k == 0 else right[b])
                        jacobian[places[j, a], places[k, b]] += factor * block[j, k]
