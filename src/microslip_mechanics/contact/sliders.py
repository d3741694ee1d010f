"""The tractions that are part of a state: of contacts that remember."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import ContactPoints

ROUNDING = 1e-12
"""of the largest motion of a contact: a direction that moves less does not move"""


@dataclass(frozen=True, slots=True)
class Sliders:
    """The tractions that are part of a state: one for each direction that can slide."""

    points: ContactPoints
    basis: Array
    """relative displacements of the points from the coordinates, (3 points, rank)"""
    point: NDArray[np.int64]
    """of each slider, shape (sliders,)"""
    axis: NDArray[np.int64]
    """0 or 1: along which tangent, shape (sliders,)"""
    floating: Floating | None = None
    """mean motions that sliders alone hold; none if left out"""

    @classmethod
    def of(
        cls, points: ContactPoints, basis: Array, floating: Floating | None = None
    ) -> Sliders:
        """Return the sliders of a contact table: none where no contact remembers."""
        sizes = np.abs(basis).max(axis=1, initial=0.0)
        moves = (sizes > ROUNDING * sizes.max(initial=0.0)).reshape(-1, 3)[:, 1:]
        point, axis = np.nonzero(moves & remembers(points)[:, None])
        return cls(points, basis, point, axis, floating)

    @property
    def count(self) -> int:
        """Number of sliders."""
        return int(self.point.size)

    @property
    def along(self) -> Array:
        """Displacement of each slider from the coordinates, shape (sliders, rank)."""
        rows: Array = self.basis[3 * self.point + 1 + self.axis]
        return rows

    @property
    def stiffness(self) -> Array:
        """k_t [N/m], shape (sliders,)."""
        found: Array = self.points.tangential[self.point]
        return found

    def bent(self, mean: Array) -> Array:
        """Return what sliders carry that stick in the mean [N], shape (points, 2).

        ``mean`` is the displacement of the points [m], shape ``(points, 3)``.
        """
        if self.floating is None:
            return np.zeros((len(mean), 2))
        lean = self.floating.lean(mean.ravel())
        carried: Array = self.points.tangential[:, None] * lean[:, 1:]
        return carried

    @property
    def bending(self) -> Array:
        """Derivative of :meth:`bent` by the mean of y [N/m], shape (sliders, rank)."""
        if self.floating is None:
            return np.zeros_like(self.along)
        lean = self.floating.directions @ (self.floating.directions.T @ self.basis)
        made: Array = self.stiffness[:, None] * lean[3 * self.point + 1 + self.axis]
        return made

    def seen(self, traction: Array | None) -> Array:
        """Return the sliders' part of all tractions, (points, 2); zero if None."""
        if traction is None:
            return np.zeros(self.count)
        found: Array = traction[self.point, self.axis]
        return found

    def spread(self, held: Array) -> Array:
        """Return the tractions of all points, shape (points, 2)."""
        tractions = np.zeros((self.points.load.size, 2))
        tractions[self.point, self.axis] = held
        return tractions
