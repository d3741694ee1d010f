"""Harmonic balance at a fold: one more unknown, one more equation (theory §6.4)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hbm.balance.linearisation import Linearisation
from hbm.continuation.correction import Correction
from hbm.continuation.newton import Small
from hbm.continuation.settler import Unsettled
from microslip_mechanics.arrays import Array

SHIFT = 1e-5
"""of the motion, relative, for derivatives of the Jacobian along it"""
DIFFERENCE = 1e-5
"""of the parameter, over its unit, for derivatives by it"""

Inner: TypeAlias = Callable[[Array], tuple[Array, Linearisation]]
"""balance at one parameter; the last component of its points is the frequency"""


class Borders(NamedTuple):
    """What makes the Jacobian regular at a fold: unit vectors, (unknowns,) each."""

    column: Array
    """near the left null vector"""
    row: Array
    """near the right null vector"""


class FoldLinearisation(Linearisation):
    """The derivative of the extended residual, and the null vectors at its point."""

    borders: Borders


class FoldBalance(Unsettled):
    """Residual R(y, ω; λ), and g, which is zero where ∂R/∂y is singular.

    A point is that of harmonic balance followed by the parameter λ. As a settler it
    brings the borders up to date with each point that is kept.
    """

    def __init__(
        self,
        at: Callable[[float], Inner],
        unit: Callable[[float], float],
        places: NDArray[np.int64],
        means: int,
    ) -> None:
        """Plan for balances that depend on a parameter.

        Parameters
        ----------
        at
            Parameter ↦ balance.
        unit
            Parameter ↦ the change of it that counts.
        places
            Where the unknowns are in a point, shape ``(unknowns,)``.
        means
            Number of components at the beginning of a point that do not vibrate.
        """
        self._at, self._unit, self._places, self._means = at, unit, places, means
        self._borders: Borders | None = None
        self._size = 1.0
        self._settled: Correction | None = None

    def __call__(self, point: Array) -> tuple[Array, FoldLinearisation]:
        """Return R and g times the vibration [N], and what solves with the derivative.

        The residual has the shape ``(size − 1,)``.
        """
        residual, here = self._at(float(point[-1]))(point[:-1])
        if self._borders is None:
            left, _, right = np.linalg.svd(here.jacobian)
            self._borders = Borders(left[:, -1], right[-1])
            self._size = self.vibration(point)
        right, left, value = _bordered(here.jacobian, self._borders)
        by_unknowns, slopes = self._derivatives(point, residual, here, right, left)
        inner = np.column_stack([here.jacobian, here.slope])
        jacobian = np.vstack([inner, by_unknowns])
        linearised = FoldLinearisation(
            lambda: (jacobian, slopes),
            np.append(self._places, point.size - 2),
            point.size,
        )
        linearised.borders = Borders(_unit(left), _unit(right))
        return np.append(residual, self._size * value), linearised

    def settle(
        self,
        correction: Correction,
        normal: Array,  # noqa: ARG002
        tolerance: float,  # noqa: ARG002
        small: Small | None = None,  # noqa: ARG002
    ) -> Correction:
        """Return the point, and remember it."""
        self._settled = correction
        return correction

    def keep(self, step: float = math.inf) -> None:  # noqa: ARG002
        """Take the null vectors of the last point as borders."""
        if self._settled is not None:
            self.begin(self._settled)

    def begin(self, correction: Correction) -> None:
        """Take borders from a point of this system, or of one with fewer harmonics."""
        linearised = correction.linearised
        if isinstance(linearised, FoldLinearisation):
            missing = self._places.size - linearised.borders.row.size
            self._borders = Borders(
                *(np.pad(each, (0, missing)) for each in linearised.borders)
            )
            self._size = self.vibration(correction.point)

    def vibration(self, point: Array) -> float:
        """Return the size of what vibrates at a point."""
        return float(np.linalg.norm(point[self._means : -2])) or 1.0

    def _derivatives(
        self,
        point: Array,
        residual: Array,
        here: Linearisation,
        right: Array,
        left: Array,
    ) -> tuple[Array, Array]:
        """Return ∂g/∂(y, ω), and ∂(R, g)/∂λ; g is in units of force.

        ∂g/∂X = −wᵀ (∂J/∂X) v. Second derivatives are symmetric: (∂J/∂y_j) v is the
        change of column j of J along v, (∂J/∂ω) v that of ∂R/∂ω.
        """
        beside = point[:-1].copy()
        shift = SHIFT * self.vibration(point) / float(np.linalg.norm(right))
        beside[self._places] += shift * right
        _, moved = self._at(float(point[-1]))(beside)
        difference = DIFFERENCE * self._unit(float(point[-1]))
        later, changed = self._at(float(point[-1]) + difference)(point[:-1])
        along = np.append(
            left @ (moved.jacobian - here.jacobian), left @ (moved.slope - here.slope)
        )
        across = float(left @ ((changed.jacobian - here.jacobian) @ right))
        return -self._size / shift * along, np.append(
            (later - residual)[self._places], -self._size * across
        ) / difference


def beyond(here: Inner, image: Inner) -> Inner:
    """Return the balance beyond the range, where there need be no problem.

    It goes on as it does before the border: R(λ) = 2 R(border) − R(2 border − λ).
    """

    def continued(point: Array) -> tuple[Array, Linearisation]:
        residual, linearised = here(point)
        before, falling = image(point)
        return 2.0 * residual - before, linearised.beyond(falling)

    return continued


def _bordered(jacobian: Array, borders: Borders) -> tuple[Array, Array, float]:
    """Return v, w and g with J v + b g = 0, cᵀ v = 1; Jᵀ w + c g = 0, bᵀ w = 1.

    They are not finite where the bordered matrix has no inverse.
    """
    count = len(jacobian)
    matrix = np.zeros((count + 1, count + 1))
    matrix[:count, :count] = jacobian
    matrix[:count, count], matrix[count, :count] = borders
    one = np.append(np.zeros(count), 1.0)
    try:
        inverse_last = np.linalg.solve(matrix, one)
        transposed = np.linalg.solve(matrix.T, one)
    except np.linalg.LinAlgError:
        lost = np.full(count, np.nan)
        return lost, lost, np.nan
    return inverse_last[:count], transposed[:count], float(inverse_last[count])


def _unit(vector: Array) -> Array:
    unit: Array = vector / float(np.linalg.norm(vector))
    return unit
