"""What a factor over a period does to Fourier coefficients, as a matrix (§6.1)."""

from __future__ import annotations

import numpy as np

from hbm.forces.by_thread import ByThread
from hbm.forces.fourier import Transform, to_complex
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import inner_kernel, kernel


def multiplied(now: Array, rate: Array, harmonics: int) -> Array:
    """Return the matrix of f(θ) x(θ) + g(θ) x'(θ) by the coefficients of x.

    Parameters
    ----------
    now, rate
        f and g at the samples, shape ``(samples,)``, at least ``4 harmonics + 2``.
    harmonics
        Of x, and of what is made of it.

    Returns
    -------
    Matrix, shape ``(2 harmonics + 1, 2 harmonics + 1)``.
    """
    transform = _transform(2, now.size)
    transform.samples[0], transform.samples[1] = now, rate
    spectra = to_complex(transform.analysis(2 * harmonics)).T
    spectra[:, 1:] *= 0.5
    matrix = np.empty((2 * harmonics + 1, 2 * harmonics + 1))
    _write(spectra[0].copy(), spectra[1].copy(), matrix)
    return matrix


_transform = ByThread(Transform)


@kernel
def _write(now: ComplexArray, rate: ComplexArray, matrix: Array) -> None:
    """Write the matrix of two factors, of which orders from 0 are given."""
    harmonics = matrix.shape[0] // 2
    for j in range(harmonics + 1):
        share = 0.5 if j == 0 else 1.0
        for k in range(harmonics + 1):
            cosines, sines = _pair(now, j, k)
            turned, turning = _pair(rate, j, k)
            a, b = max(2 * j - 1, 0), max(2 * k - 1, 0)
            matrix[a, b] = share * (cosines[0] - k * turned[1])
            if k > 0:
                matrix[a, b + 1] = share * (cosines[1] + k * turned[0])
            if j > 0:
                matrix[a + 1, b] = sines[0] - k * turning[1]
            if j > 0 and k > 0:
                matrix[a + 1, b + 1] = sines[1] + k * turning[0]


@inner_kernel
def _pair(
    factor: ComplexArray, j: int, k: int
) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return cosine and sine j of the factor times cosine k and sine k."""
    above = factor[j + k]
    between = factor[j - k] if j >= k else np.conj(factor[k - j])
    return (
        (above.real + between.real, between.imag - above.imag),
        (-above.imag - between.imag, between.real - above.real),
    )
