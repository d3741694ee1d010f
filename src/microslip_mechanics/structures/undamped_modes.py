"""The undamped modes of dense matrices, down to what is not rounding."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array

ROUNDING = 100.0 * float(np.finfo(float).eps)
"""of the work of a motion's stiffness, over that of its entries' sizes"""


HIDDEN = 1e-9
"""error of an eigenvalue, relative, that is more than usual rounding"""


def undamped_modes(stiffness: Array, mass: Array | None = None) -> tuple[Array, Array]:
    """Return the squares of frequencies, nearly in order, and shapes of unit mass.

    Where the stiffest of many elements hides a slow mode in the rounding of its
    eigenvalue, Rayleigh's quotient takes its place, which is far more accurate. What is
    rounding beside the entries that a mode moves is zero: that mode is free.

    Parameters
    ----------
    stiffness, mass
        Shape (dofs, dofs), symmetric; unit mass if left out.
    """
    squares, shapes = scipy.linalg.eigh(stiffness, mass)
    quotients = np.einsum("ij,ij->j", shapes, stiffness @ shapes)
    sizes = np.abs(shapes)
    parts = np.einsum("ij,ij->j", sizes, np.abs(stiffness) @ sizes)
    hidden = np.abs(quotients - squares) > HIDDEN * np.abs(quotients)
    squares[hidden] = quotients[hidden]
    squares[np.abs(quotients) <= ROUNDING * parts] = 0.0
    return squares, shapes
