"""A structure with pushes on rigid contacts as further coordinates (theory §6.5).

The traction λ of rigid friction is no function of the motion w. It is one of the push
g = λ + (m s² + c s) w on a mass m with a dashpot c that slides at the contact; in the
coordinates (y, g/κ) only the slide of that mass is nonlinear (eqs. 19b, 19c).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.structure.condensed import Condensed, Loading
from microslip_mechanics.arrays import Array, ComplexArray

LOOSE = 1e-9
"""η: share of the traction by which it is pinned where sticking leaves it free"""


@dataclass(frozen=True, slots=True)
class Tractions:
    """Tractions of rigid contacts, each along one tangent of a point."""

    places: NDArray[np.int64]
    """row of each among the relative displacements of the points, shape (count,)"""
    rows: Array
    """map from y to the sliding displacements w, shape (count, rank)"""
    scale: Array
    """κ [N/m], shape (count,)"""
    mass: Array
    """m [kg], shape (count,)"""
    rate: float
    """c / m [1/s]"""

    def restricted(self, kept: NDArray[np.int64]) -> Tractions:
        """Return those of some of the coordinates (y, g/κ)."""
        rank = self.rows.shape[1]
        own, left = kept[kept >= rank] - rank, kept[kept < rank]
        return Tractions(
            self.places[own],
            self.rows[np.ix_(own, left)],
            self.scale[own],
            self.mass[own],
            self.rate,
        )

    def creep(self, frequency: float, force: float) -> float:
        """Return how far η lets a force move contacts that stick at a frequency [m]."""
        rates = frequency * np.hypot(frequency, self.rate)
        return float((LOOSE * force / (self.mass * rates)).max(initial=0.0))

    def work(self, amplitudes: ComplexArray, frequency: float) -> float:
        """Return the energy [J] that λ takes out per period."""
        rank = self.rows.shape[1]
        variable = 1j * frequency * np.arange(len(amplitudes))[:, None]
        speed = variable * (amplitudes[:, :rank] @ self.rows.T)
        push = self.scale * amplitudes[:, rank:]
        traction = push - self.mass * (variable + self.rate) * speed
        return float(np.pi / frequency * (traction * speed.conj()).real.sum())


@dataclass(frozen=True, slots=True)
class PushedStructure:
    """A structure as the coordinates (y, g/κ) see it."""

    inner: Condensed
    """as y sees it"""
    tractions: Tractions

    @property
    def stiffness(self) -> Array:
        """Static stiffness of mean motions [N/m]."""
        still: Array = self.dynamic_stiffness(np.zeros(1, complex))[0].real
        return still

    @property
    def mass(self) -> Array:
        """Mass that goes with it [kg]; pushes have none."""
        count = len(self.tractions.rows)
        return np.pad(self.inner.mass, ((0, count), (0, count)))

    @property
    def static(self) -> Array:
        """Static motion from the coordinates, shape (dofs, rank + count)."""
        return np.pad(self.inner.static, ((0, 0), (0, len(self.tractions.rows))))

    def restricted(
        self, kept: NDArray[np.int64], force: ComplexArray
    ) -> PushedStructure:
        """Return the structure seen by some coordinates, the others held still."""
        rank = self.tractions.rows.shape[1]
        return PushedStructure(
            self.inner.restricted(kept[kept < rank], force),
            self.tractions.restricted(kept),
        )

    def possible(self, orders: int) -> NDArray[np.bool_]:
        """Return which coordinates can move in orders 0, 1, …."""
        moves = self.inner.possible(orders)
        felt = moves.astype(float) @ np.abs(self.tractions.rows).T > 0.0
        return np.hstack([moves, felt])

    def dynamic_stiffness(
        self, variable: ComplexArray, wanted: NDArray[np.bool_] | None = None
    ) -> ComplexArray:
        """Return S(s) of (y, g/κ), shape (orders, rank + count, rank + count)."""
        rows, scale = self.tractions.rows, self.tractions.scale
        count, rank = rows.shape
        constant = np.zeros((rank + count, rank + count))
        constant[:rank, rank:] = rows.T * scale
        constant[rank:, rank:] = (1.0 + LOOSE) * np.diag(scale)
        s = variable[:, None, None]
        value: ComplexArray = constant + s * (s + self.tractions.rate) * self._inertial
        seen = None if wanted is None else wanted[:, :rank]
        value[:, :rank, :rank] += self.inner.dynamic_stiffness(variable, seen)
        return value

    def slope(self, variable: ComplexArray, relative: ComplexArray) -> ComplexArray:
        """Return (dS/ds) (y, g/κ), shape (orders, rank + count)."""
        rank = self.tractions.rows.shape[1]
        turning = (2.0 * variable + self.tractions.rate)[:, None]
        own = self.inner.slope(variable, relative[:, :rank])
        pushed = np.zeros((len(variable), len(self.tractions.rows)))
        slope: ComplexArray = np.hstack([own, pushed])
        return slope + turning * (relative @ self._inertial.T)

    @property
    def _inertial(self) -> ComplexArray:
        """What goes with s (s + rate), shape (rank + count, rank + count)."""
        rows = self.tractions.rows
        count, rank = rows.shape
        felt = self.tractions.mass[:, None] * rows
        inertial = np.zeros((rank + count, rank + count), complex)
        inertial[:rank, :rank] = -rows.T @ felt
        inertial[rank:, :rank] = -(1.0 + LOOSE) * felt
        return inertial

    def loading(self, force: ComplexArray) -> Loading:
        """Return how loads reach the coordinates; none of them are pushes."""
        inner, none = self.inner.loading(force), np.zeros(len(self.tractions.rows))

        def load(variable: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
            left = np.tile(none, (len(variable), 1))
            value, change = inner(variable)
            return np.hstack([value, left]), np.hstack([change, left])

        return load

    def motion(
        self, variable: ComplexArray, relative: ComplexArray, force: ComplexArray
    ) -> ComplexArray:
        """Return u from the coordinates and the loads, shape (orders, dofs)."""
        rank = self.tractions.rows.shape[1]
        return self.inner.motion(variable, relative[:, :rank], force)
