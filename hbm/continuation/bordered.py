"""A Jacobian bordered by a column and a row, factored."""

from __future__ import annotations

import numpy as np
from scipy.linalg import lapack

from hbm.continuation.linearised import SingularError
from microslip_mechanics.arrays import Array


class Bordered:
    """Factors of [Jacobian slope; border]."""

    def __init__(self, jacobian: Array, slope: Array, border: Array) -> None:
        """Factor it.

        Parameters
        ----------
        jacobian
            Shape ``(unknowns, unknowns)``.
        slope
            Last column, shape ``(unknowns,)``.
        border
            Last row, shape ``(unknowns + 1,)``.

        Raises
        ------
        SingularError
            If it has no inverse.
        """
        count = slope.size
        matrix = np.empty((count + 1, count + 1))
        matrix[:count, :count] = jacobian
        matrix[:count, count] = slope
        matrix[count] = border
        # the transpose: it lies by rows
        *self._factors, failed = lapack.dgetrf(matrix.T, overwrite_a=True)
        if failed != 0:
            raise SingularError

    @property
    def sign(self) -> float:
        """That of the determinant."""
        factors, pivots = self._factors
        negative = np.count_nonzero(factors.diagonal() < 0.0)
        swapped = np.count_nonzero(pivots != np.arange(pivots.size))
        return 1.0 if (negative + swapped) % 2 == 0 else -1.0

    def solve(self, right: Array) -> Array:
        """Return the solution, of shape ``(unknowns + 1,)`` or with several columns.

        Raises
        ------
        SingularError
            If there is none.
        """
        found, failed = lapack.dgetrs(*self._factors, right, trans=1)
        if failed != 0:
            raise SingularError
        solution: Array = found
        return solution
