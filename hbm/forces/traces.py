"""Motion and forces of contact points over a period: samples and Fourier series.

Displacement and velocity are transformed together, by one product or one transform.
Where half a period tells the other half, the points are looked at in the first alone.
"""

from __future__ import annotations

import numpy as np

from hbm.forces.fourier import FourierBasis, Transform
from hbm.forces.sampling import Forces, hat
from microslip_mechanics.arrays import Array


class Traces:
    """Buffers of one period, valid until the next call that writes them."""

    def __init__(self, basis: Array, fourier: FourierBasis, signs: Array) -> None:
        """Plan for ``basis``, the map from y to the points, ``(3 points, rank)``.

        ``signs`` are those by which coordinates differ after half a period, (rank,);
        empty if they do not differ by signs alone.
        """
        rows, rank = basis.shape
        samples = fourier.samples
        self._basis, self._fourier, self._signs = basis, fourier, signs
        self.calls = 0
        """number of motions so far: the buffers have what the last one made"""
        self._direct = rows == rank and np.array_equal(basis, np.eye(rows))
        self._half = samples // 2 if signs.size else samples
        self._orders = np.arange(1, fourier.harmonics + 1)[:, None]
        self._series = np.zeros((fourier.coefficients, 2 * rank))
        self._motion = Transform(2 * rank, samples)
        self._moved = np.empty((2, 0 if self._direct else rows, self.seen))
        self._transforms = Transform(2 * rank, samples), Transform(2 * rank, samples)
        self._hat = hat(fourier.harmonics, samples)[:, None]
        self._on = [each.samples.reshape(2, rank, samples) for each in self._transforms]
        self._acting = self._on
        if not self._direct:
            self._acting = [np.zeros((2, rows, samples)) for _ in self._on]
        force, change = self._acting
        self.regular = Forces(force[0], change[0])
        """what the samples see"""
        self.extra = Forces(force[1], change[1])
        """what transitions between them add"""

    @property
    def seen(self) -> int:
        """Number of samples, from the first on, at which the points are looked at.

        That is half a period and one more, or all.
        """
        return self._half + (1 if self._signs.size else 0)

    def motion(
        self, coefficients: Array, frequency: float, decay: float
    ) -> tuple[Array, Array]:
        """Return displacement and velocity of the points at the samples seen, or all.

        A motion that dies away at the rate ``decay`` is slower by as much of what moves
        about the mean.
        """
        self.calls += 1
        rank, series = self._basis.shape[1], self._series
        turning = frequency * self._orders
        series[:, :rank] = coefficients
        np.multiply(turning, coefficients[2::2], out=series[1::2, rank:])
        np.multiply(-turning, coefficients[1::2], out=series[2::2, rank:])
        if decay != 0.0:
            series[1:, rank:] -= decay * coefficients[1:]
        moved = self._motion.synthesis(series).reshape(2, rank, self._fourier.samples)
        if not self._direct:
            moved = np.matmul(self._basis, moved[:, :, : self.seen], out=self._moved)
        return moved[0], moved[1]

    def forces(self) -> Array:
        """Return the series of the force on y, ``(2H + 1, rank)``, transitions too."""
        return self._gathered(0)

    def changes(self) -> Array:
        """Return the same of (∂force/∂velocity) velocity."""
        return self._gathered(1)

    def force(self, harmonics: int) -> Array:
        """Return the series of :meth:`forces`, last asked, at another order."""
        fading = hat(harmonics, self._fourier.samples)[:, None]
        return self._analysed(0, harmonics, fading)

    def _gathered(self, kind: int) -> Array:
        """Return the series of what acts on y; :meth:`_analysed` can give it again."""
        half = self._half
        on = self._on[kind]
        if not self._direct:
            acting = self._acting[kind][:, :, :half]
            np.matmul(self._basis.T, acting, out=on[:, :, :half])
        if self._signs.size:
            np.multiply(self._signs[:, None], on[:, :, :half], out=on[:, :, half:])
        return self._analysed(kind, self._fourier.harmonics, self._hat)

    def _analysed(self, kind: int, harmonics: int, fading: Array) -> Array:
        """Return the series at an order, ``(2 harmonics + 1, rank)``."""
        rank = self._basis.shape[1]
        series = self._transforms[kind].analysis(harmonics)
        whole: Array = series[:, :rank] + series[:, rank:] / fading
        return whole
