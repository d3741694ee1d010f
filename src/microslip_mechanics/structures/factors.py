"""Factors of a sparse symmetric matrix, and whether it is positive definite."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from microslip_mechanics.arrays import Array, Matrix

SMALLEST = 1e-14
"""pivot over the matrix's own diagonal element, below which it counts as zero"""


@dataclass(frozen=True, slots=True)
class Factors:
    """LU factors of a sparse symmetric matrix A with pivots on the diagonal.

    By Sylvester's law of inertia the signs of the pivots are those of the eigenvalues.
    """

    decomposed: scipy.sparse.linalg.SuperLU
    pivots: Array
    """in the order of the matrix"""

    def solve(self, right: Array) -> Array:
        """Return A⁻¹ right, for ``right`` of shape (size,) or (size, several)."""
        found: Array = self.decomposed.solve(np.ascontiguousarray(right))
        return found

    def root(self, columns: Array) -> Array:
        """Return S x of columns x, shape (size, several), where SᵀS = A."""
        upper = self.decomposed.U
        ordered = columns[np.argsort(self.decomposed.perm_c)]
        found: Array = (upper @ ordered) / np.sqrt(upper.diagonal())[:, None]
        return found


def factors(matrix: Matrix) -> Factors | None:
    """Return the factors of a symmetric matrix; None if not positive definite."""
    found = indefinite_factors(matrix)
    if found is None:
        return None
    definite = (
        found.pivots > SMALLEST * scipy.sparse.csc_array(matrix).diagonal()
    ).all()
    return found if definite else None


def indefinite_factors(matrix: Matrix) -> Factors | None:
    """Return the factors of a symmetric matrix; None if a pivot vanishes."""
    try:
        found = scipy.sparse.linalg.splu(
            scipy.sparse.csc_array(matrix),
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
    except RuntimeError:  # exactly singular
        return None
    if not np.array_equal(found.perm_r, found.perm_c):
        return None
    return Factors(found, found.U.diagonal()[found.perm_c])
