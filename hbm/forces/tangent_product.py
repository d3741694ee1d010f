"""Contact tangents over a period, by which motions are multiplied (theory §6.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.forces.by_thread import ByThread
from hbm.forces.fourier import Transform, derivative
from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel


class TangentProduct:
    """The product 𝓜[∂f/∂y] y + ω 𝓜[∂f/∂ẏ] D y (eq. 18) by way of the samples.

    At least 4H + 2 samples make it the same as that of the assembled Jacobian.
    """

    def __init__(self, tangents: Array, samples: int, signs: Array) -> None:
        """Take the tangents at samples of a period.

        Parameters
        ----------
        tangents
            ∂f/∂y [N/m] and ∂f/∂ẏ [N s/m] of the coordinates at each sample, shape
            ``(2, rank, rank, samples)``; half of the samples where ``signs`` say what
            the other half is.
        samples
            Of a period.
        signs
            By which signs the coordinates differ after half a period, ``(rank,)``; ones
            where all samples are given.
        """
        self._tangents, self._samples, self._signs = tangents, samples, signs
        used: NDArray[np.bool_] = (tangents != 0.0).any(axis=3)
        self._linked: NDArray[np.bool_] = used[0] | used[1]
        self._damped = bool(used[1].any())

    def __call__(self, coefficients: Array, frequency: float) -> Array:
        """Return the change of the force [N] with that of the motion [m].

        Both have shape ``(2H + 1, rank)``; ``frequency`` is in rad/s.
        """
        rank = coefficients.shape[1]
        series = coefficients
        if self._damped:
            series = np.hstack([series, frequency * derivative(series)])
        motion, force = _buffers(series.shape[1], rank, self._samples)
        moved = motion.synthesis(series)
        _multiply(self._tangents, self._linked, moved, self._signs, force.samples)
        return force.analysis(len(coefficients) // 2)


@ByThread
def _buffers(motions: int, rank: int, samples: int) -> tuple[Transform, Transform]:
    """Return room for displacements, velocities too if they count, and the force."""
    return Transform(motions, samples), Transform(rank, samples)


@kernel
def _multiply(
    tangents: Array,
    linked: NDArray[np.bool_],
    moved: Array,
    signs: Array,
    force: Array,
) -> None:
    """Write what changes of displacement and velocity, (2 rank, samples), make.

    Velocities are left out where they make nothing. ``linked`` says which coordinates
    see each other, shape ``(rank, rank)``.
    """
    rank, seen = tangents.shape[1], tangents.shape[3]
    for row in range(rank):
        force[row] = 0.0
        for column in np.flatnonzero(linked[row]):
            for place in range(seen):
                force[row, place] += (
                    tangents[0, row, column, place] * moved[column, place]
                )
            if moved.shape[0] == rank:
                continue
            for place in range(seen):
                force[row, place] += (
                    tangents[1, row, column, place] * moved[rank + column, place]
                )
        for place in range(seen, force.shape[1]):
            force[row, place] = signs[row] * force[row, place - seen]
