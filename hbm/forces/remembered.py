"""What friction that remembers makes of small motions, without a matrix (theory §6.1).

The derivative of a traction at a sample is by what moves there and by what moved where
the present stick began (:mod:`microslip_mechanics.contact.loop_gradient`): the former
is a tangent like any other, the latter a few numbers in a period.
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.by_thread import ByThread
from hbm.forces.fourier import FourierBasis, Transform, derivative
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.loop_gradient import LoopGradient
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import BRISTLE, PUSHED, ContactPoints
from microslip_mechanics.jit import kernel

FEW, MOST = 16, 5e7
"""runs of a slider along one direction, and numbers that derivatives may take"""


def fits(points: ContactPoints, basis: Array, fourier: FourierBasis) -> bool:
    """Return whether the derivatives of all loops fit into memory.

    What slides in two directions, and a bristle, which creeps, have a run for each
    sample. What is pushed has no runs.
    """
    moves = (basis.reshape(points.friction.size, 3, basis.shape[1]) != 0.0).any(axis=2)
    many = moves[:, 1:].all(axis=1) | (points.friction == BRISTLE)
    runs = np.where(many, fourier.samples, FEW)[remembers(points)].sum()
    numbers = 6.0 * runs * fourier.coefficients
    return not (points.friction == PUSHED).any() and bool(numbers <= MOST)


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
        self._rest = _rests(loops)
        self._directions = np.flatnonzero(self._seen.any(axis=1))
        self._damped = bool(self._rate.any())

    def product(self, coefficients: Array) -> Array:
        """Return the change of the force [N] with that of the motion [m].

        Both have shape ``(2H + 1, rank)``.
        """
        seen: Array = coefficients @ self._seen.T
        seen[0] = self._mean @ coefficients[0]
        points, samples = self._run.shape
        before = self._rest @ seen.T.reshape(points, -1, 1)
        series = seen[:, self._directions]
        if self._damped:
            series = np.hstack([series, derivative(series)])
        motion, traction = _buffers(series.shape[1], 2 * points, samples)
        _multiply(
            (self._now, self._rate, self._run),
            before.reshape(points, -1, 2),
            motion.synthesis(series),
            self._directions,
            traction.samples,
        )
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


def _rests(loops: list[Loop]) -> Array:
    """Return the derivatives by what came before, (points, 2 runs, 3 (2H + 1))."""
    runs = max(int(each.gradient.run.max()) + 1 for each in loops)
    made = np.zeros((len(loops), runs, 2, 3, loops[0].gradient.rest.shape[3]))
    for filled, loop in zip(made, loops, strict=True):
        moves = (loop.seen != 0.0).any(axis=1)
        kept = int(loop.gradient.run.max()) + 1
        for row, column in itertools.product(*map(np.flatnonzero, (moves[1:], moves))):
            filled[:kept, row, column] = loop.gradient.rest[:kept, row, column]
    return made.reshape(len(loops), 2 * runs, -1)


@ByThread
def _buffers(motions: int, tractions: int, samples: int) -> tuple[Transform, Transform]:
    """Return room for the motions, their slopes too if they count, and tractions."""
    return Transform(motions, samples), Transform(tractions, samples)


_factors = ByThread(Transform)


@kernel
def _multiply(
    gradient: tuple[Array, Array, NDArray[np.int64]],
    before: Array,
    moved: Array,
    directions: NDArray[np.int64],
    traction: Array,
) -> None:
    """Write the tractions, shape (2 points, samples), of displacements and slopes.

    ``gradient`` are now, rate and run, ``directions`` those of the displacements; the
    slopes lie behind these, or are left out.
    """
    now, rate, run = gradient
    count, samples = directions.size, run.shape[1]
    for row in range(len(traction)):
        for place in range(samples):
            traction[row, place] = before[row // 2, run[row // 2, place], row % 2]
    for there in range(count):
        point, column = divmod(directions[there], 3)
        for row in range(2):
            made = traction[2 * point + row]
            for place in range(samples):
                made[place] += now[point, row, column, place] * moved[there, place]
            if len(moved) > count:
                slope = moved[count + there]
                for place in range(samples):
                    made[place] += rate[point, row, column, place] * slope[place]
