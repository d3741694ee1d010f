"""Solutions with the bordered Jacobian of harmonic balance (theory, eqs. 18–19)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hbm.balance.iterated import Iterated, Parts, UnreachedError
from hbm.continuation.factors import Factors, factored
from hbm.continuation.linearised import SingularError
from microslip_mechanics.arrays import Array

EPSILON = 1e-14
"""relative size below which a border does not cross the curve"""


class Linearisation:
    """The residual's derivative at a point, bordered by one more row when it solves."""

    def __init__(
        self,
        make: Callable[[], tuple[Array, Array]],
        places: NDArray[np.int64],
        size: int,
        parts: Callable[[], Parts] | None = None,
        rank: int = 0,
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
        parts
            Returns as much of them as it takes to solve by iteration, if that is likely
            to cost less.
        rank
            Of the coordinates of which a point holds the coefficients, if it does:
            those that couple no orders are eliminated.
        """
        self._make, self.parts, self._rank = make, parts, rank
        self._made: tuple[Array, Array] | None = None
        self._places = np.append(places, size - 1)
        self._factors: tuple[Array, Factors | Iterated] | None = None

    @property
    def exact(self) -> bool:
        """Whether solutions come from factors, not from iterations."""
        return self.parts is None

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

    def with_slope(self, slope: Array) -> Linearisation:
        """Return the same with another derivative by the last component."""
        places, last, parts = self._places[:-1], int(self._places[-1]), self.parts
        inner = slope[places]
        return Linearisation(
            lambda: (self._make()[0], inner),
            places,
            last + 1,
            None if parts is None else lambda: parts()._replace(slope=inner),
            self._rank,
        )

    def continued(self, image: Linearisation) -> Linearisation:
        """Return that of 2 R(border) − R(image), this one being at the border."""

        def made() -> tuple[Array, Array]:
            there, slope = image._make()
            return 2.0 * self._make()[0] - there, slope

        last = int(self._places[-1])
        return Linearisation(made, self._places[:-1], last + 1, rank=self._rank)

    def beyond(self, image: Linearisation) -> Linearisation:
        """Return that of 2 R(this) − R(image) at one point."""

        def made() -> tuple[Array, Array]:
            (here, slope), (there, other) = self._make(), image._make()
            return 2.0 * here - there, 2.0 * slope - other

        last = int(self._places[-1])
        return Linearisation(made, self._places[:-1], last + 1, rank=self._rank)

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
        wanted = right[self._places]
        try:
            found = self._bordered(border, wanted)
        except UnreachedError:
            self.parts, self._factors = None, None
            found = self._bordered(border, wanted)
        if not np.all(np.isfinite(found)):
            raise SingularError
        solution = np.zeros_like(right)
        solution[self._places] = found
        return solution

    def iterated(self, normal: Array, right: Array) -> Array | None:
        """Return what :meth:`solve` does if iterations give it, else nothing."""
        if self.parts is None:
            return None
        solution = np.zeros_like(right)
        try:
            solver = Iterated(self.parts(), normal[self._places])
            solution[self._places] = solver.solve(right[self._places])
        except UnreachedError:
            return None
        return solution

    def _bordered(self, border: Array, right: Array) -> Array:
        """Return the solution of the unknowns, and keep what solves."""
        if self._factors is None:
            self._factors = border, self._factored(border)
        known, factors = self._factors
        if np.array_equal(border, known):
            return factors.solve(right)
        return _turned(factors, border, right)

    def orientation(self, tangent: Array) -> float:
        """Return the sign of the determinant that has the tangent as its border.

        0 if what solves is not factors of all unknowns, or none yet.
        """
        if self._factors is None:
            return 0.0
        border, factors = self._factors
        if isinstance(factors, Iterated):
            return 0.0
        return factors.sign * float(np.sign(border @ tangent[self._places]))

    def forget(self) -> None:
        """Let go of derivatives and factors: what solves again makes them anew."""
        self._made, self._factors = None, None

    def _factored(self, border: Array) -> Factors | Iterated:
        """Return what solves with the bordered matrix."""
        if self.parts is not None:
            return Iterated(self.parts(), border)
        orders = coordinates = None
        if self._rank:
            terms, coordinates = np.divmod(self._places[:-1], self._rank)
            orders = (terms + 1) // 2
        factors = factored(self.jacobian, self.slope, border, orders, coordinates)
        self._made = None  # as large as the factors, and hardly ever asked again
        return factors


def _turned(factors: Factors | Iterated, border: Array, right: Array) -> Array:
    """Return the solution with another border, by a step along the tangent.

    It begins where the factored border makes zero of it, so that the step is not lost
    to rounding if the other border is far larger.
    """
    last, right = right[-1].copy(), right.copy()
    right[-1] = 0.0
    found = factors.solve(right)
    unit = np.zeros(border.size)
    unit[-1] = 1.0
    along = factors.solve(unit)
    across = float(border @ along)
    if abs(across) <= EPSILON * float(np.abs(border) @ np.abs(along)):
        raise SingularError
    shares = (last - border @ found) / across
    turned: Array = found + np.multiply.outer(along, shares)
    return turned
