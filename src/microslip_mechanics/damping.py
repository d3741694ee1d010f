"""Damping of a structure: a matrix, one ratio for all modes, or Rayleigh's."""

from __future__ import annotations

import numpy as np
import scipy.linalg
import scipy.sparse

from microslip_mechanics.arrays import Matrix
from microslip_mechanics.factors import indefinite_factors

ROUNDING = 1e-9
"""over the largest entry: so little energy from a damping matrix is rounding"""


def rayleigh(mass: Matrix, stiffness: Matrix, alpha: float, beta: float) -> Matrix:
    """Return α M + β K, α in 1/s and β in s."""
    for name, value in (("alpha", alpha), ("beta", beta)):
        if not 0.0 <= value < np.inf:
            raise ValueError(
                f"Rayleigh damping {name} = {value:g}: give 0 or more, a negative one "
                "puts energy in"
            )
    return alpha * mass + beta * stiffness


def modal(mass: Matrix, stiffness: Matrix, ratio: float) -> Matrix:
    """Return the matrix that damps each mode of M, K by one ratio of critical.

    Modes that no stiffness holds are not damped.
    """
    if scipy.sparse.issparse(mass):
        raise ValueError(
            "damping_ratio needs all modes of the structure, which is sparse: give "
            "Rayleigh damping or a damping matrix"
        )
    if not 0.0 <= ratio < 1.0:
        raise ValueError(
            f"damping_ratio = {ratio:g}: give 0 to below 1, a share of critical damping"
        )
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    rates = np.sqrt(np.maximum(squares, 0.0))
    momenta = mass @ shapes
    return (momenta * (2.0 * ratio * rates)) @ momenta.T


def check_dissipates(damping: Matrix, names: tuple[str, ...]) -> None:
    """Check that a symmetric damping matrix puts no energy in.

    Raises
    ------
    ValueError
        With the degree of freedom that gains most.
    """
    diagonal = damping.diagonal()
    if diagonal.size and diagonal.min() < 0.0:
        place = int(diagonal.argmin())
        raise ValueError(
            f"damping of {names[place]} is {diagonal[place]:g} N s/m: negative damping "
            "puts energy in, give 0 or more"
        )
    size = abs(damping).max() if diagonal.size else 0.0
    if size == 0.0:
        return
    sparse = bool(scipy.sparse.issparse(damping))
    if sparse:
        shift = ROUNDING * size * scipy.sparse.eye_array(len(names), format="csc")
        found = indefinite_factors(damping.tocsc() + shift)
        gains = found is not None and bool((found.pivots < 0.0).any())
        where = "some motion"
    else:
        rates, shapes = np.linalg.eigh(damping)
        gains = bool(rates[0] < -ROUNDING * size)
        where = f"a motion mostly of {names[int(np.abs(shapes[:, 0]).argmax())]}"
    if gains:
        raise ValueError(
            f"damping puts energy into {where}: give a matrix without negative "
            "eigenvalues"
        )
