"""Solutions with the bordered Jacobian of harmonic balance (theory, eqs. 18–20)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from hbm.newton import SingularError
from microslip_mechanics.arrays import Array


class Linearisation:
    """The residual's derivative at a point, bordered by one more row when it solves."""

    def __init__(
        self, jacobian: Array, slope: Array, places: NDArray[np.int64], size: int
    ) -> None:
        """Take the derivatives by the unknowns and by the last component of a point.

        Parameters
        ----------
        jacobian
            ∂R/∂y of the unknowns, shape ``(unknowns, unknowns)``.
        slope
            Derivative by the last component, shape ``(unknowns,)``.
        places
            Where the unknowns are in a point, shape ``(unknowns,)``.
        size
            Number of components of a point.
        """
        self.jacobian, self.slope = jacobian, slope
        self._places = np.append(places, size - 1)
        self._normal: Array = np.empty(0)
        self._factors: tuple[Array, Array] = (np.empty(0), np.empty(0))

    def along(self, slope: Array) -> Linearisation:
        """Return the same, ``slope`` being the derivative by the last component."""
        places, last = self._places[:-1], int(self._places[-1])
        return Linearisation(self.jacobian, slope[places], places, last + 1)

    def solve(self, normal: Array, right: Array) -> Array:
        """Solve [Jacobian slope; normal] d = right.

        ``normal`` has shape ``(size,)``, ``right`` that or ``(size, several)``.
        Components that are not solved for stay zero.

        Raises
        ------
        SingularError
            If there is no solution.
        """
        if not np.array_equal(normal, self._normal):
            self._factors, self._normal = self._factored(normal), normal
        found, failed = lapack.dgetrs(*self._factors, right[self._places])
        if failed != 0 or not np.all(np.isfinite(found)):
            raise SingularError
        solution = np.zeros_like(right)
        solution[self._places] = found
        return solution

    def _factored(self, normal: Array) -> tuple[Array, Array]:
        """Return the factors of the bordered matrix."""
        count = self.slope.size
        matrix = np.empty((count + 1, count + 1), order="F")
        matrix[:count, :count] = self.jacobian
        matrix[:count, count] = self.slope
        matrix[count] = normal[self._places]
        factors, pivots, failed = lapack.dgetrf(matrix, overwrite_a=True)
        if failed != 0:
            raise SingularError
        return factors, pivots
