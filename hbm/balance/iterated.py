"""Solutions of a large bordered Jacobian by GMRES, its low orders factored (§6.1).

Factors of all orders cost the cube of their number. Of the high orders a band is enough
for nearly the inverse.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.sparse.linalg import LinearOperator, gmres

from hbm.continuation.bordered import Bordered
from hbm.continuation.linearised import SingularError
from microslip_mechanics.arrays import Array

PRECISE, ROUGH = 1e-7, 1e-5
"""what is left of a solution's residual, measured as motion; the second of a step in
the plane across the border, which is corrected by what comes after it"""
SHARE = 10
"""unknowns for each product that a solution may take: more cost as much as factors"""


class UnreachedError(ArithmeticError):
    """GMRES took too many products, or the parts of a Jacobian have no inverse."""


class Parts(NamedTuple):
    """A Jacobian by unknowns, the low orders first, as far as it is made."""

    product: Callable[[Array], Array]
    """it times a vector of shape (unknowns,)"""
    corner: Array
    """its low orders, shape (low, low)"""
    apart: Callable[[Array], Array]
    """nearly its inverse in the high orders, shape (unknowns − low,)"""
    slope: Array
    """derivative by the last component of a point, shape (unknowns,)"""


class Iterated:
    """What solves [Jacobian slope; border] d = right from the parts of a Jacobian."""

    def __init__(self, parts: Parts, border: Array) -> None:
        """Factor the low orders, bordered by what ``border``, (unknowns + 1,), has.

        Raises
        ------
        UnreachedError
            If they alone are singular, which says nothing of all orders.
        """
        self._parts, self._border = parts, border
        self._low = low = len(parts.corner)
        ends = np.append(border[:low], border[-1])
        try:
            self._corner = Bordered(parts.corner, parts.slope[:low], ends)
        except SingularError:
            raise UnreachedError from None

    def solve(self, right: Array) -> Array:
        """Return the solution, of shape ``(unknowns + 1,)`` or with several columns.

        Raises
        ------
        UnreachedError
            If it takes more than one product for :data:`SHARE` unknowns, or if low or
            high orders alone have none.
        """
        if right.ndim == 1:
            return self._solution(right)
        return np.column_stack([self._solution(each) for each in right.T])

    def _solution(self, right: Array) -> Array:
        """Return the solution of one right side.

        It is sought in the units of what the parts make of it, so that the last
        component counts as much as all of the motion.
        """
        nearly = self._nearly(right)
        if not np.isfinite(nearly).all():
            raise UnreachedError
        units = np.ones_like(nearly)
        moved, last = float(np.linalg.norm(nearly[:-1])), abs(float(nearly[-1]))
        if moved > 0.0 and last > 0.0:
            units[-1] = last / moved
        made = LinearOperator(
            (right.size, right.size),
            matvec=lambda tried: self._nearly(self._product(units * tried)) / units,
            dtype=float,
        )
        products = 0

        def counted(_: float) -> None:
            nonlocal products
            products += 1
            if products > right.size // SHARE:
                raise UnreachedError

        found, failed = gmres(
            made,
            nearly / units,
            rtol=PRECISE if right[-1] else ROUGH,
            restart=right.size // SHARE + 1,
            callback=counted,
            callback_type="pr_norm",
        )
        if failed:
            raise UnreachedError
        solution: Array = units * found
        return solution

    def _product(self, step: Array) -> Array:
        """Return the bordered Jacobian times a step."""
        parts = self._parts
        changed = parts.product(step[:-1]) + step[-1] * parts.slope
        return np.append(changed, self._border @ step)

    def _nearly(self, right: Array) -> Array:
        """Return about the solution: low orders by themselves, and high ones."""
        low, parts = self._low, self._parts
        inner = self._corner.solve(np.append(right[:low], right[-1]))
        outer = parts.apart(right[low:-1] - inner[-1] * parts.slope[low:])
        return np.concatenate([inner[:-1], outer, inner[-1:]])
