"""Assembly of the Jacobian for the unknowns that are asked for (eqs. 18–19)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel

MEAN, COSINE, SINE = 0, 1, 2


class Spectra(NamedTuple):
    """Fourier coefficients of the tangents on y, shape (2H + 1, rank, rank) each."""

    stiffness_cosine: Array
    """of ∂f/∂y [N/m]"""
    stiffness_sine: Array
    damping_cosine: Array
    """of ∂f/∂ẏ [N s/m]"""
    damping_sine: Array


@kernel
def assemble(
    spectra: Spectra,
    elastic: Array,
    viscous: Array,
    frequency: float,
    unknowns: NDArray[np.intp],
) -> Array:
    """Return ∂R/∂y for some unknowns.

    Parameters
    ----------
    spectra
        Of the contact tangents.
    elastic, viscous
        Real and imaginary part of the condensed stiffness, ``(H + 1, rank, rank)``.
    frequency
        Excitation frequency [rad/s].
    unknowns
        Flat indices into coefficients of shape ``(2H + 1, rank)``, ``(unknowns,)``.

    Returns
    -------
    Shape ``(unknowns, unknowns + 1)``; the last column is left for ∂R/∂ω.
    """
    size, rank = unknowns.size, elastic.shape[1]
    jacobian = np.zeros((size, size + 1))
    for row in range(size):
        place, a = divmod(unknowns[row], rank)
        j, kind = (place + 1) // 2, _kind(place)
        for column in range(size):
            place, b = divmod(unknowns[column], rank)
            k, other = (place + 1) // 2, _kind(place)
            value = _product(
                spectra.stiffness_cosine,
                spectra.stiffness_sine,
                a,
                b,
                j,
                kind,
                k,
                other,
            )
            if other != MEAN:
                # the rate of cos kθ is −kω sin kθ, that of sin kθ is kω cos kθ
                turned = SINE if other == COSINE else COSINE
                rate = -k * frequency if other == COSINE else k * frequency
                value += rate * _product(
                    spectra.damping_cosine,
                    spectra.damping_sine,
                    a,
                    b,
                    j,
                    kind,
                    k,
                    turned,
                )
            if j == k:
                value += _linear(elastic[k, a, b], viscous[k, a, b], kind, other)
            jacobian[row, column] = value
    return jacobian


@kernel
def _kind(place: int) -> int:
    if place == 0:
        return MEAN
    return COSINE if place % 2 == 1 else SINE


@kernel
def _linear(elastic: float, viscous: float, kind: int, other: int) -> float:
    """Return the part of one order of the structure (theory, eq. 18)."""
    if kind == other:
        return elastic
    return viscous if kind == COSINE else -viscous


@kernel
def _product(
    cosine: Array, sine: Array, a: int, b: int, j: int, kind: int, k: int, other: int
) -> float:
    """Return how a coefficient of k(θ) y(θ) follows from one of y (theory, eq. 19)."""
    if other == MEAN:
        return float(cosine[j, a, b] if kind != SINE else sine[j, a, b])
    if kind == MEAN:
        return 0.5 * float(cosine[k, a, b] if other == COSINE else sine[k, a, b])
    apart = abs(j - k)
    if kind == other:
        near = cosine[apart, a, b] * (2.0 if apart == 0 else 1.0)
        far = cosine[j + k, a, b]
        return 0.5 * float(near + far if kind == COSINE else near - far)
    near = sine[apart, a, b] if j >= k else -sine[apart, a, b]
    far = sine[j + k, a, b]
    return 0.5 * float(far - near if kind == COSINE else far + near)
