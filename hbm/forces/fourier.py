"""Real Fourier coefficients and samples of one period; the only import of pyfftw.

A signal is a₀ + Σ aₖ cos kθ + bₖ sin kθ; its coefficients are stored in the order
a₀, a₁, b₁, a₂, b₂, … along the first axis (theory, eq. 12).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from operator import attrgetter

import numpy as np
import pyfftw

from microslip_mechanics.arrays import Array, ComplexArray

PRODUCT, FEW = 2**14, 7
"""entries of a matrix, or harmonics, up to which a product by it is faster than a fast
transform, by ``tests/benchmarks/growth.py``"""


@dataclass(frozen=True, slots=True)
class FourierBasis:
    """Number of harmonics of the solution and of samples per period."""

    harmonics: int
    samples: int
    threshold: float = 0.0
    """threshold velocity [m/s] below which friction is not resolved"""

    def __post_init__(self) -> None:
        """Check that the samples resolve the products that the Jacobian needs."""
        if self.harmonics < 1:
            raise ValueError(f"{self.harmonics} harmonics: take at least 1")
        if self.samples < 4 * self.harmonics + 2:
            raise ValueError(
                f"{self.samples} samples per period cannot carry {self.harmonics} "
                f"harmonics: take at least {4 * self.harmonics + 2}"
            )

    @property
    def coefficients(self) -> int:
        """Number of real coefficients per signal."""
        return 2 * self.harmonics + 1

    @property
    def doubled(self) -> FourierBasis:
        """Twice the resolution, odd orders staying odd."""
        orders = 2 * self.harmonics + 1
        samples = max(2 * self.samples, 4 * orders + 4)
        return replace(self, harmonics=orders, samples=samples)


by_harmonics = attrgetter("harmonics")
"""what resolutions are compared by"""


def usual_samples(harmonics: int) -> int:
    """Return the number of samples per period that so many fixed harmonics have."""
    return 16 * (harmonics + 1)


class Transform:
    """Transforms of a fixed number of signals: products by a matrix, or FFTW's.

    Products are faster up to :data:`PRODUCT` entries of the matrix, or :data:`FEW`
    harmonics.
    """

    def __init__(self, signals: int, samples: int) -> None:
        """Make room for arrays of shape ``(signals, samples)``."""
        self._time: Array = pyfftw.zeros_aligned((signals, samples), dtype="float64")

    def synthesis(self, coefficients: Array) -> Array:
        """Return samples, shape ``(signals, samples)``, valid until the next call.

        ``coefficients`` has shape ``(2 harmonics + 1, signals)``.
        """
        harmonics, samples = len(coefficients) // 2, self._time.shape[1]
        if multiplies(harmonics, samples):
            there, _ = _small_waves(harmonics, samples)
            np.dot(coefficients.T, there, out=self._time)
            return self._time
        spectrum, _, backward = self._planned
        spectrum[:] = 0.0
        spectrum[:, 0] = coefficients[0]
        half = to_complex(coefficients)[1:] / 2.0
        spectrum[:, 1 : harmonics + 1] = half.T
        backward.execute()
        return self._time

    @property
    def samples(self) -> Array:
        """Where samples for :meth:`analysis` are written, ``(signals, samples)``."""
        return self._time

    def analysis(self, harmonics: int) -> Array:
        """Return coefficients of :attr:`samples`, ``(2 harmonics + 1, signals)``."""
        samples = self._time.shape[1]
        if multiplies(harmonics, samples):
            _, back = _small_waves(harmonics, samples)
            coefficients: Array = np.dot(back, self._time.T)
            return coefficients
        spectrum, forward, _ = self._planned
        forward.execute()
        kept = spectrum[:, : harmonics + 1].T / samples
        kept[1:] *= 2.0
        return to_real(kept)

    @cached_property
    def _planned(self) -> tuple[ComplexArray, pyfftw.FFTW, pyfftw.FFTW]:
        """Half the spectrum, and FFTW's plans there and back."""
        signals, samples = self._time.shape
        spectrum: ComplexArray = pyfftw.zeros_aligned(
            (signals, samples // 2 + 1), dtype="complex128"
        )
        estimate = ("FFTW_ESTIMATE",)
        return (
            spectrum,
            pyfftw.FFTW(self._time, spectrum, flags=estimate),
            pyfftw.FFTW(
                spectrum, self._time, direction="FFTW_BACKWARD", flags=estimate
            ),
        )


def multiplies(harmonics: int, samples: int) -> bool:
    """Return whether signals are transformed by a product."""
    return harmonics <= FEW or (2 * harmonics + 1) * samples <= PRODUCT


def waves(harmonics: int, samples: int) -> tuple[Array, Array]:
    """Return the matrices of synthesis and of analysis, (2 harmonics + 1, samples)."""
    phase = 2.0 * np.pi * np.arange(samples) / samples
    angles = np.outer(np.arange(1, harmonics + 1), phase)
    there = np.ones((2 * harmonics + 1, samples))
    there[1::2], there[2::2] = np.cos(angles), np.sin(angles)
    back = there * (2.0 / samples)
    back[0] *= 0.5
    return there, back


_small_waves = lru_cache(maxsize=64)(waves)


def to_complex(coefficients: Array) -> ComplexArray:
    """Return cₖ = aₖ − i bₖ, ``(harmonics + 1, …)``: the signal is Re Σ cₖ exp ikθ."""
    amplitudes = np.empty(
        (coefficients.shape[0] // 2 + 1, *coefficients.shape[1:]), complex
    )
    amplitudes[0] = coefficients[0]
    amplitudes[1:] = coefficients[1::2] - 1j * coefficients[2::2]
    return amplitudes


def to_real(amplitudes: ComplexArray) -> Array:
    """Return aₖ and bₖ from complex amplitudes: the inverse of :func:`to_complex`."""
    coefficients = np.empty((2 * amplitudes.shape[0] - 1, *amplitudes.shape[1:]))
    coefficients[0] = amplitudes[0].real
    coefficients[1::2] = amplitudes[1:].real
    coefficients[2::2] = -amplitudes[1:].imag
    return coefficients


def derivative(coefficients: Array) -> Array:
    """Return the coefficients of the derivative by the phase θ."""
    slopes = np.zeros_like(coefficients)
    orders = np.arange(1, coefficients.shape[0] // 2 + 1)
    orders = orders.reshape(-1, *[1] * (coefficients.ndim - 1))
    slopes[1::2] = orders * coefficients[2::2]
    slopes[2::2] = -orders * coefficients[1::2]
    return slopes
