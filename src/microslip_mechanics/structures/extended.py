"""Products in extended precision, for stiffness whose terms nearly cancel."""

from __future__ import annotations

import numpy as np
import scipy.sparse

from microslip_mechanics.arrays import Array, Matrix


def extended_product(matrix: Matrix, columns: Array) -> Array:
    """Return ``matrix @ columns``, summed in extended precision where it is sparse.

    A smooth motion strains a fine mesh so little that the forces of neighbours nearly
    cancel: by N⁴ among N elements along a beam. Where the platform has no longer
    numbers than float64, these are used.
    """
    if scipy.sparse.issparse(matrix):
        operator: Matrix = matrix
        long = operator.tocsr().astype(np.longdouble)
        summed = long @ columns.astype(np.longdouble)
        return np.asarray(summed, dtype=float)
    return np.asarray(matrix @ columns)
