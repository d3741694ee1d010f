"""Assembly of the Jacobian for the unknowns that are asked for (theory, eqs. 18–19)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.touch_factors import touch_factors
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import inner_kernel, kernel


class Terms(NamedTuple):
    """Orders of a Fourier series to solve for, by coordinate; shape (terms,) each."""

    coordinate: NDArray[np.int64]
    order: NDArray[np.int64]
    cosine: NDArray[np.int64]
    """place of the cosine (or mean) among the unknowns"""
    sine: NDArray[np.int64]
    """place of the sine among the unknowns; −1 for a mean"""
    unknowns: NDArray[np.int64]
    """flat place of each unknown among all coefficients, shape (unknowns,)"""
    places: NDArray[np.int64]
    """which unknown each coefficient is, −1 for the others, shape (2H + 1, rank)"""


def terms(active: NDArray[np.bool_]) -> Terms:
    """Return the terms of ``active`` coefficients, shape (2H + 1, rank).

    Cosine and sine of one order are active together.
    """
    places = np.where(active, active.cumsum().reshape(active.shape) - 1, -1)
    rows = [
        (coordinate, order, places[max(2 * order - 1, 0), coordinate], sine)
        for coordinate in range(active.shape[1])
        for order in range(active.shape[0] // 2 + 1)
        if active[2 * order, coordinate]
        for sine in [places[2 * order, coordinate] if order else -1]
    ]
    table = np.array(rows, dtype=np.int64).reshape(-1, 4).T
    coordinate, order, cosine, sine = np.ascontiguousarray(table)
    return Terms(coordinate, order, cosine, sine, np.flatnonzero(active), places)


def jacobian(
    contact: AlternatingFrequencyTime,
    stiffness: ComplexArray,
    frequency: float,
    terms: Terms,
    growth: float = 0.0,
) -> Array:
    """Return ∂R/∂y of the terms where the contacts were called last.

    ``stiffness`` is that of the structure, ``(H + 1, rank, rank)``; for the others, and
    what is returned, see :func:`assemble`.
    """
    made = assemble(
        *contact.tangents.spectra(2 * (len(stiffness) - 1)),
        np.ascontiguousarray(stiffness.real),
        np.ascontiguousarray(stiffness.imag),
        frequency,
        terms,
        growth,
    )
    contact.add_remembered(terms.places, made)
    touched = touch_factors(contact, terms.places)
    if touched is not None:
        made += touched.matrix
    return made


@kernel
def assemble(
    stiffness: Array,
    damping: Array,
    elastic: Array,
    viscous: Array,
    frequency: float,
    terms: Terms,
    growth: float = 0.0,
) -> Array:
    """Return ∂R/∂y of the terms.

    Parameters
    ----------
    stiffness, damping
        Coefficients of the contact tangents ∂f/∂y [N/m] and ∂f/∂ẏ [N s/m] up to order
        2H, in the order a₀, a₁, b₁, …; shape ``(rank, rank, 4H + 1)``.
    elastic, viscous
        Real and imaginary part of the condensed stiffness, ``(H + 1, rank, rank)``.
    frequency
        Excitation frequency [rad/s].
    terms
        What is solved for.
    growth
        Rate [1/s] at which all motions but the mean grow: it adds as much of these
        motions to their velocity.

    Returns
    -------
    Shape ``(unknowns, unknowns)``.
    """
    size = terms.unknowns.size
    jacobian = np.zeros((size, size))
    grown = stiffness + growth * damping
    linked = _linked(stiffness, damping)
    for row in range(terms.order.size):
        a, j = terms.coordinate[row], terms.order[row]
        top, bottom = terms.cosine[row], terms.sine[row]
        for column in range(terms.order.size):
            b, k = terms.coordinate[column], terms.order[column]
            left, right = terms.cosine[column], terms.sine[column]
            if not linked[a, b] and j != k:
                continue
            series = grown if k > 0 else stiffness
            cc, cs, sc, ss = _product(series[a, b], j, k)
            vcc, vcs, vsc, vss = _product(damping[a, b], j, k)
            # the rate of cos kθ is −kω sin kθ, that of sin kθ is kω cos kθ
            rate = k * frequency
            real, imaginary = 0.0, 0.0
            if j == k:
                real, imaginary = elastic[k, a, b], viscous[k, a, b]
            jacobian[top, left] = cc - rate * vcs + real
            if right >= 0:
                jacobian[top, right] = cs + rate * vcc + imaginary
            if bottom >= 0:
                jacobian[bottom, left] = sc - rate * vss - imaginary
                if right >= 0:
                    jacobian[bottom, right] = ss + rate * vsc + real
    return jacobian


@kernel
def _linked(stiffness: Array, damping: Array) -> NDArray[np.bool_]:
    """Return which coordinates see each other in a contact, (rank, rank)."""
    rank, _, terms = stiffness.shape
    linked = np.zeros((rank, rank), dtype=np.bool_)
    for a in range(rank):
        for b in range(rank):
            for term in range(terms):
                if stiffness[a, b, term] != 0.0 or damping[a, b, term] != 0.0:
                    linked[a, b] = True
                    break
    return linked


@inner_kernel
def _product(series: Array, j: int, k: int) -> tuple[float, float, float, float]:
    """Return how order j of k(θ) y(θ) follows from order k of y (theory, eq. 19).

    By cosine from cosine, cosine from sine, sine from cosine, sine from sine; the mean
    counts as cosine of order 0.
    """
    if j == 0:
        if k == 0:
            return series[0], 0.0, 0.0, 0.0
        return 0.5 * series[2 * k - 1], 0.5 * series[2 * k], 0.0, 0.0
    far_cosine, far_sine = series[2 * (j + k) - 1], series[2 * (j + k)]
    if j == k:
        near_cosine, near_sine = 2.0 * series[0], 0.0
    elif j > k:
        near_cosine, near_sine = series[2 * (j - k) - 1], series[2 * (j - k)]
    else:
        near_cosine, near_sine = series[2 * (k - j) - 1], -series[2 * (k - j)]
    return (
        0.5 * (near_cosine + far_cosine),
        0.5 * (far_sine - near_sine),
        0.5 * (far_sine + near_sine),
        0.5 * (near_cosine - far_cosine),
    )
