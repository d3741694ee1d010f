"""Motion and forces of contact points over a period: samples and Fourier series.

Both are transformed together: one product, or one transform, for displacement and
velocity, and one for the forces and their derivatives.
"""

from __future__ import annotations

import numpy as np

from hbm.fourier import FourierBasis, Transform
from hbm.sampling import Forces, hat
from microslip_mechanics.arrays import Array


class Traces:
    """Buffers of one period, valid until the next call that writes them."""

    def __init__(self, basis: Array, fourier: FourierBasis) -> None:
        """Plan for ``basis``, the map from y to the points, ``(3 points, rank)``."""
        rows, rank = basis.shape
        samples = fourier.samples
        self._basis, self._fourier = basis, fourier
        self._direct = rows == rank and np.array_equal(basis, np.eye(rows))
        self._orders = np.arange(1, fourier.harmonics + 1)[:, None]
        self._series = np.zeros((fourier.coefficients, 2 * rank))
        self._motion = Transform(2 * rank, samples)
        self._force = Transform(4 * rank, samples)
        self._hat = hat(fourier.harmonics, samples)[:, None, None]
        room = self._force.samples.reshape(4, rank, samples)
        self._seen = room
        if not self._direct:
            room = np.zeros((4, rows, samples))
        self._acting = room
        self.regular = Forces(room[0], room[2])
        """what the samples see"""
        self.extra = Forces(room[1], room[3])
        """what transitions between them add"""

    def motion(
        self, coefficients: Array, frequency: float, decay: float, seen: int
    ) -> tuple[Array, Array]:
        """Return displacement and velocity of the points at the samples.

        A motion that dies away at the rate ``decay`` is slower by as much of what moves
        about the mean. ``seen`` is the number of samples that are needed, from the
        first on; there may be more.
        """
        rank, series = self._basis.shape[1], self._series
        turning = frequency * self._orders
        series[:, :rank] = coefficients
        series[1::2, rank:] = turning * coefficients[2::2]
        series[2::2, rank:] = -turning * coefficients[1::2]
        if decay != 0.0:
            series[1:, rank:] -= decay * coefficients[1:]
        moved = self._motion.synthesis(series)
        if self._direct:
            return moved[:rank], moved[rank:]
        return (
            np.dot(self._basis, moved[:rank, :seen]),
            np.dot(self._basis, moved[rank:, :seen]),
        )

    def forces(self) -> tuple[Array, Array]:
        """Return the series of force and change on y, ``(2H + 1, rank)`` each.

        Transitions are part of them.
        """
        if not self._direct:
            np.matmul(self._basis.T, self._acting, out=self._seen)
        force, change = self._analysed(self._fourier.harmonics, 2).swapaxes(0, 1)
        return force, change

    def force(self, harmonics: int) -> Array:
        """Return the same series of the force at another order, of the last call."""
        force: Array = self._analysed(harmonics, 1)[:, 0]
        return force

    def _analysed(self, harmonics: int, kinds: int) -> Array:
        """Return the series of the force, and of its change if two kinds are wanted.

        The shape is ``(2 harmonics + 1, kinds, rank)``.
        """
        rank, fading = self._basis.shape[1], self._hat
        if harmonics != self._fourier.harmonics:
            fading = hat(harmonics, self._fourier.samples)[:, None, None]
        series = self._force.analysis(harmonics, 2 * kinds * rank)
        parts = series.reshape(len(series), kinds, 2, rank)
        whole: Array = parts[:, :, 0] + parts[:, :, 1] / fading
        return whole
