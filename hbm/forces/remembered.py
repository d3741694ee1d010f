"""What friction that remembers makes of small motions, without a matrix (theory §6.1).

The derivative of a traction at a sample is by what moves there and by what moved where
the present stick began (:mod:`microslip_mechanics.contact.loop_gradient`): the former
is a tangent like any other, the latter a few numbers in a period.
"""

from __future__ import annotations

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import Transform, derivative
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.loop_gradient import LoopGradient
from microslip_mechanics.jit import kernel


class Loop(NamedTuple):
    """The derivatives of one point's tractions over a period."""

    seen: Array
    """map from y to the point, shape (3, rank)"""
    mean: Array
    """the same of means, shape (3, rank)"""
    gradient: LoopGradient


class Remembered:
    """What contacts that remember add to ∂force/∂y."""

    def __init__(self, loops: list[Loop], frequency: float) -> None:
        """Take the loops of all points that remember, at a frequency [rad/s]."""
        self._frequency = frequency
        self._seen = np.vstack([each.seen for each in loops])
        self._mean = np.vstack([each.mean for each in loops])
        self._acts = np.vstack([each.seen[1:] for each in loops])
        gradients = [each.gradient for each in loops]
        self._now = np.stack([each.now for each in gradients])
        self._rate = np.stack([each.rate for each in gradients])
        self._run = np.stack([each.run for each in gradients])
        self._rest = [_rest(each) for each in loops]

    def product(self, coefficients: Array) -> Array:
        """Return the change of the force [N] with that of the motion [m].

        Both have shape ``(2H + 1, rank)``.
        """
        seen: Array = coefficients @ self._seen.T
        seen[0] = self._mean @ coefficients[0]
        points, samples = self._run.shape
        motion, traction = _buffers(points, samples)
        before = np.zeros((points, samples + 1, 2))
        for point, rest in enumerate(self._rest):
            moved = seen[:, 3 * point : 3 * point + 3]
            before[point, : len(rest)] = np.tensordot(rest, moved.T, 2)
        moved = motion.synthesis(np.hstack([seen, derivative(seen)]))
        _multiply(self._now, self._rate, self._run, before, moved, traction.samples)
        force: Array = traction.analysis(len(coefficients) // 2) @ self._acts
        return force

    def series(self, harmonics: int) -> tuple[Array, Array]:
        """Return the series of ∂force/∂y and ∂force/∂ẏ by what moves at a sample.

        Each has shape ``(rank, rank, 2 harmonics + 1)``.
        """
        points, samples = self._run.shape
        transform = _factors(12 * points, samples)
        transform.samples[: 6 * points] = self._now.reshape(-1, samples)
        transform.samples[6 * points :] = self._rate.reshape(-1, samples)
        parts = transform.analysis(harmonics).reshape(-1, 2, points, 2, 3)
        acts, seen = (
            each.reshape(points, -1, each.shape[1]) for each in (self._acts, self._seen)
        )
        both = np.einsum("tkprc,pra,pcb->kabt", parts, acts, seen, optimize=True)
        return both[0], both[1] / self._frequency


def _rest(loop: Loop) -> Array:
    """Return the derivatives by what came before, shape (runs, 2, 3, 2H + 1)."""
    runs = int(loop.gradient.run.max()) + 1
    rest = loop.gradient.rest[:runs].copy()
    still = ~(loop.seen != 0.0).any(axis=1)
    rest[:, still[1:]] = 0.0
    rest[:, :, still] = 0.0
    return rest


@lru_cache(maxsize=8)
def _buffers(points: int, samples: int) -> tuple[Transform, Transform]:
    """Return room for displacement and slope, and for the tractions."""
    return Transform(6 * points, samples), Transform(2 * points, samples)


_factors = lru_cache(maxsize=8)(Transform)


@kernel
def _multiply(
    now: Array,
    rate: Array,
    run: NDArray[np.int64],
    before: Array,
    moved: Array,
    traction: Array,
) -> None:
    """Write the tractions, (2 points, samples), of displacements and their slopes."""
    points, samples = run.shape
    for point in range(points):
        for row in range(2):
            made = traction[2 * point + row]
            for place in range(samples):
                made[place] = before[point, run[point, place], row]
            for column in range(3):
                there, slope = 3 * point + column, 3 * (points + point) + column
                for place in range(samples):
                    made[place] += (
                        now[point, row, column, place] * moved[there, place]
                        + rate[point, row, column, place] * moved[slope, place]
                    )
