"""The undamped modes of dense matrices, down to what is not rounding."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array

ROUNDING = 100.0 * float(np.finfo(float).eps)
"""of the work of a motion's stiffness, over that of its entries' sizes"""


def undamped_modes(stiffness: Array, mass: Array | None = None) -> tuple[Array, Array]:
    """Return the squares of frequencies, nearly in order, and shapes of unit mass.

    Squares are Rayleigh's quotients: where the stiffest of many elements hides a slow
    mode in the rounding of an eigenvalue, they are far more accurate. What is rounding
    beside the entries that a mode moves is zero: that mode is free.

    Parameters
    ----------
    stiffness, mass
        Shape (dofs, dofs), symmetric; unit mass if left out.
    """
    _, shapes = scipy.linalg.eigh(stiffness, mass)
    squares: Array = np.einsum("ij,ij->j", shapes, stiffness @ shapes)
    sizes = np.abs(shapes)
    parts = np.einsum("ij,ij->j", sizes, np.abs(stiffness) @ sizes)
    squares[np.abs(squares) <= ROUNDING * parts] = 0.0
    return squares, shapes
