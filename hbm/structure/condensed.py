"""What harmonic balance asks of a structure that is condensed onto its contacts."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray

Loading: TypeAlias = Callable[[ComplexArray], tuple[ComplexArray, ComplexArray]]
"""s of each order ↦ the load that reaches y and its derivative by s, (orders, rank)"""


class Condensed(Protocol):
    """A structure as the relative coordinates y of its contacts see it."""

    @property
    def stiffness(self) -> Array:
        """Static stiffness of mean motions [N/m], shape (rank, rank)."""

    @property
    def mass(self) -> Array:
        """Mass that goes with it [kg], shape (rank, rank)."""

    @property
    def static(self) -> Array:
        """T: static motion from y, shape (dofs, rank)."""

    def restricted(self, kept: NDArray[np.int64], force: ComplexArray) -> Condensed:
        """Return the structure seen by some coordinates, the others held still."""

    def possible(self, orders: int) -> NDArray[np.bool_]:
        """Return which coordinates can move in orders 0, 1, …, (orders, rank)."""

    def dynamic_stiffness(
        self, variable: ComplexArray, wanted: NDArray[np.bool_] | None = None
    ) -> ComplexArray:
        """Return S(s), shape (orders, rank, rank)."""

    def slope(self, variable: ComplexArray, relative: ComplexArray) -> ComplexArray:
        """Return (dS/ds) y of each order, (orders, rank)."""

    def loading(self, force: ComplexArray) -> Loading:
        """Return how loads reach y; ``force`` [N] has shape (orders, dofs)."""

    def motion(
        self, variable: ComplexArray, relative: ComplexArray, force: ComplexArray
    ) -> ComplexArray:
        """Return u from y and the loads, shape (orders, dofs).

        Also of several y under one load, if each has about the same variable.
        """
