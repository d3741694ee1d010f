"""A structure with trial tractions of rigid friction as further coordinates (§6).

Rigid friction is no function of the motion. Its traction λ is the projection of a trial
τ = λ + ε v on the disc of friction, for any weight ε > 0; in the coordinates (y, τ/κ)
the projection is the only nonlinearity, and everything else is linear (eq. 19b, 19c).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.condensation import Condensed
from microslip_mechanics.arrays import Array, ComplexArray

LOOSE = 1e-8
"""η: share of the traction by which it is pinned where sticking leaves it free"""


@dataclass(frozen=True, slots=True)
class Tractions:
    """Trial tractions of rigid contacts, each along one tangent of a point."""

    places: NDArray[np.int64]
    """row of each among the relative displacements of the points, shape (count,)"""
    rows: Array
    """map from y to the sliding displacements, shape (count, rank)"""
    scale: Array
    """κ [N/m], shape (count,)"""
    weight: Array
    """ε [N s/m], shape (count,)"""

    def restricted(self, kept: NDArray[np.int64]) -> Tractions:
        """Return those of some of the coordinates (y, τ/κ)."""
        rank = self.rows.shape[1]
        own, left = kept[kept >= rank] - rank, kept[kept < rank]
        return Tractions(
            self.places[own],
            self.rows[np.ix_(own, left)],
            self.scale[own],
            self.weight[own],
        )

    def of(self, variable: ComplexArray, amplitudes: ComplexArray) -> ComplexArray:
        """Return λ [N], shape (orders, count), of the coordinates' amplitudes."""
        rank = self.rows.shape[1]
        speed = variable[:, None] * (amplitudes[:, :rank] @ self.rows.T)
        traction: ComplexArray = (
            self.scale * amplitudes[:, rank:] - self.weight * speed
        )
        return traction

    def work(self, amplitudes: ComplexArray, frequency: float) -> float:
        """Return the energy [J] that λ takes out per period."""
        variable = 1j * frequency * np.arange(len(amplitudes))
        traction = self.of(variable, amplitudes)
        rank = self.rows.shape[1]
        speed = variable[:, None] * (amplitudes[:, :rank] @ self.rows.T)
        return float(np.pi / frequency * (traction * speed.conj()).real.sum())


@dataclass(frozen=True, slots=True)
class TractionStructure:
    """A structure as the coordinates (y, τ/κ) see it."""

    inner: Condensed
    """as y sees it"""
    tractions: Tractions

    @property
    def stiffness(self) -> Array:
        """Static stiffness of mean motions [N/m]."""
        return self.dynamic_stiffness(np.zeros(1, complex))[0][0].real

    @property
    def mass(self) -> Array:
        """Mass that goes with it [kg]; tractions have none."""
        return _padded(self.inner.mass, len(self.tractions.rows))

    @property
    def static(self) -> Array:
        """Static motion from the coordinates, shape (dofs, rank + count)."""
        still = np.zeros((len(self.inner.static), len(self.tractions.rows)))
        return np.hstack([self.inner.static, still])

    def restricted(
        self, kept: NDArray[np.int64], force: ComplexArray
    ) -> TractionStructure:
        """Return the structure seen by some coordinates, the others held still."""
        rank = self.tractions.rows.shape[1]
        return TractionStructure(
            self.inner.restricted(kept[kept < rank], force),
            self.tractions.restricted(kept),
        )

    def possible(self, orders: int) -> NDArray[np.bool_]:
        """Return which coordinates can move in orders 0, 1, …."""
        moves = self.inner.possible(orders)
        felt = moves.astype(float) @ (self.tractions.rows != 0.0).T > 0.0
        return np.hstack([moves, felt])

    def dynamic_stiffness(
        self, variable: ComplexArray, wanted: NDArray[np.bool_] | None = None
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return S(s) and dS/ds of (y, τ/κ), each (orders, rank + count, rank + count).

        All but that of y is linear in s (theory, eq. 19b).
        """
        rows, scale = self.tractions.rows, self.tractions.scale
        count, rank = rows.shape
        seen = None if wanted is None else wanted[:, :rank]
        felt = self.tractions.weight[:, None] * rows
        constant, slope = np.zeros((2, rank + count, rank + count))
        constant[:rank, rank:] = rows.T * scale
        constant[rank:, rank:] = (1.0 + LOOSE) * np.diag(scale)
        slope[:rank, :rank] = -rows.T @ felt
        slope[rank:, :rank] = -(1.0 + LOOSE) * felt
        inner, change = self.inner.dynamic_stiffness(variable, seen)
        value = constant + variable[:, None, None] * slope
        value[:, :rank, :rank] += inner
        derivative = np.zeros_like(value) + slope
        derivative[:, :rank, :rank] += change
        return value, derivative

    def load(
        self, variable: ComplexArray, force: ComplexArray
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return the load on the coordinates and its derivative by s."""
        none = np.zeros((len(variable), len(self.tractions.rows)))
        load, change = self.inner.load(variable, force)
        return np.hstack([load, none]), np.hstack([change, none])

    def motion(
        self, variable: ComplexArray, relative: ComplexArray, force: ComplexArray
    ) -> ComplexArray:
        """Return u from the coordinates and the loads, shape (orders, dofs)."""
        rank = self.tractions.rows.shape[1]
        return self.inner.motion(variable, relative[:, :rank], force)


def _padded(matrix: Array, count: int) -> Array:
    """Return a matrix with so many further rows and columns of zeros."""
    return np.pad(matrix, ((0, count), (0, count)))
