"""Solutions with the bordered Jacobian of harmonic balance (theory, eqs. 18–19)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from hbm.newton import SingularError
from microslip_mechanics.arrays import Array

EPSILON = 1e-14
"""relative size below which a border does not cross the curve"""
NONE: tuple[Array, Array] = np.empty(0), np.empty(0)
"""no factors"""


class Linearisation:
    """The residual's derivative at a point, bordered by one more row when it solves."""

    def __init__(
        self,
        make: Callable[[], tuple[Array, Array]],
        places: NDArray[np.int64],
        size: int,
    ) -> None:
        """Take what makes the derivatives, when they are first asked for.

        Parameters
        ----------
        make
            Returns ∂R/∂y of the unknowns, shape ``(unknowns, unknowns)``, and the
            derivative by the last component, shape ``(unknowns,)``.
        places
            Where the unknowns are in a point, shape ``(unknowns,)``.
        size
            Number of components of a point.
        """
        self._make = make
        self._made: tuple[Array, Array] | None = None
        self._places = np.append(places, size - 1)
        self._border: Array | None = None
        self._factors = NONE

    @property
    def jacobian(self) -> Array:
        """∂R/∂y of the unknowns, shape (unknowns, unknowns)."""
        return self._derivatives[0]

    @property
    def slope(self) -> Array:
        """Derivative by the last component, shape (unknowns,)."""
        return self._derivatives[1]

    @property
    def _derivatives(self) -> tuple[Array, Array]:
        if self._made is None:
            self._made = self._make()
        return self._made

    def along(self, slope: Array) -> Linearisation:
        """Return the same, ``slope`` being the derivative by the last component."""
        places, last = self._places[:-1], int(self._places[-1])
        return Linearisation(lambda: (self.jacobian, slope[places]), places, last + 1)

    def continued(self, image: Linearisation) -> Linearisation:
        """Return that of 2 R(border) − R(image), this one being at the border."""

        def made() -> tuple[Array, Array]:
            return 2.0 * self.jacobian - image.jacobian, image.slope

        return Linearisation(made, self._places[:-1], int(self._places[-1]) + 1)

    def beyond(self, image: Linearisation) -> Linearisation:
        """Return that of 2 R(this) − R(image) at one point."""

        def made() -> tuple[Array, Array]:
            return (
                2.0 * self.jacobian - image.jacobian,
                2.0 * self.slope - image.slope,
            )

        return Linearisation(made, self._places[:-1], int(self._places[-1]) + 1)

    def solve(self, normal: Array, right: Array) -> Array:
        """Solve [Jacobian slope; normal] d = right.

        ``normal`` has shape ``(size,)``, ``right`` that or ``(size, several)``.
        Components that are not solved for stay zero.

        Raises
        ------
        SingularError
            If there is no solution.
        """
        border = normal[self._places]
        if self._border is None:
            self._factors, self._border = self._factored(border), border
            self._made = None  # as large as the factors, and hardly ever asked again
        wanted = right[self._places]
        if np.array_equal(border, self._border):
            found = self._solved(wanted)
        else:
            found = self._turned(border, wanted)
        if not np.all(np.isfinite(found)):
            raise SingularError
        solution = np.zeros_like(right)
        solution[self._places] = found
        return solution

    def forget(self) -> None:
        """Let go of derivatives and factors: what solves again makes them anew."""
        self._made, self._border, self._factors = None, None, NONE

    def _turned(self, border: Array, right: Array) -> Array:
        """Return the solution with another border, by a step along the tangent.

        It begins where the factored border makes zero of it, so that the step is not
        lost to rounding if the other border is far larger.
        """
        last, right = right[-1].copy(), right.copy()
        right[-1] = 0.0
        found = self._solved(right)
        unit = np.zeros(border.size)
        unit[-1] = 1.0
        along = self._solved(unit)
        across = float(border @ along)
        if abs(across) <= EPSILON * float(np.abs(border) @ np.abs(along)):
            raise SingularError
        shares = (last - border @ found) / across
        turned: Array = found + np.multiply.outer(along, shares)
        return turned

    def _solved(self, right: Array) -> Array:
        """Return the solution with the factors that there are."""
        found, failed = lapack.dgetrs(*self._factors, right, trans=1)
        if failed != 0:
            raise SingularError
        solution: Array = found
        return solution

    def _factored(self, border: Array) -> tuple[Array, Array]:
        """Return the factors of the bordered matrix, transposed: it lies by rows."""
        count = self.slope.size
        matrix = np.empty((count + 1, count + 1))
        matrix[:count, :count] = self.jacobian
        matrix[:count, count] = self.slope
        matrix[count] = border
        factors, pivots, failed = lapack.dgetrf(matrix.T, overwrite_a=True)
        if failed != 0:
            raise SingularError
        return factors, pivots
