"""A structure as the relative motion of its contacts sees it (theory §6.1)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hbm.structure.condensed import Loading
from hbm.structure.dynamic_stiffness import (
    dynamic_stiffness,
    returned_load,
    stiffness_slope,
)
from microslip_mechanics.arrays import Array, ComplexArray

WIDE = 12
"""coordinates from which matrix products are faster than loops that use symmetry"""
FAINT = 1e-10
"""share of the largest excitation of a pole, up to which it is rounding"""


@dataclass(frozen=True)
class CondensedStructure:
    """Dynamic stiffness seen by the relative coordinates y, and the way back to u.

    The motion is u = T y + N z + Ψ w, where z is what moves while all contacts stick
    and w what nothing holds; z is eliminated exactly at each frequency, w is not
    coupled with y. Poles and residues of the stuck structure are computed once, so
    that a frequency costs two products of rank × poles.
    """

    stiffness: Array
    """TᵀKT [N/m], shape (rank, rank)"""
    damping: Array
    """TᵀCT"""
    mass: Array
    """TᵀMT"""
    poles: ComplexArray
    """λ of the stuck structure [rad/s], shape (poles,)"""
    viscous: ComplexArray
    """coupling z ← s y in modal form, shape (poles, rank)"""
    inertial: ComplexArray
    """coupling z ← s² y in modal form, shape (poles, rank)"""
    viscous_back: ComplexArray
    """coupling y ← z in modal form, shape (rank, poles)"""
    inertial_back: ComplexArray
    """shape (rank, poles)"""
    static: Array
    """T, shape (dofs, rank)"""
    modes: ComplexArray
    """motion per modal coordinate of z, shape (dofs, poles)"""
    participation: ComplexArray
    """modal coordinate per load, shape (poles, dofs)"""
    unheld: Array
    """motions that loads alone move, of unit mass, shape (dofs, motions)"""
    coupled: NDArray[np.int64]
    """poles that y excites"""
    gyroscopic: bool = False
    """whether S(s) differs from its transpose"""

    def restricted(
        self, kept: NDArray[np.int64], force: ComplexArray
    ) -> CondensedStructure:
        """Return the structure seen by some coordinates, the others held still.

        Poles that neither the kept coordinates nor the loads ``force`` (loads, dofs)
        reach are dropped: they are not excited.
        """
        into, slow = self.inertial[:, kept], self.viscous[:, kept]
        reach = _share(np.hstack([into, self.poles[:, None] * slow]))
        loaded = _share(self.participation @ force.T)
        square = np.ix_(kept, kept)
        seen = replace(
            self,
            stiffness=self.stiffness[square],
            damping=self.damping[square],
            mass=self.mass[square],
            viscous=slow,
            inertial=into,
            viscous_back=self.viscous_back[kept],
            inertial_back=self.inertial_back[kept],
            static=self.static[:, kept],
            coupled=np.flatnonzero(reach > FAINT),
        )
        return seen.with_poles((reach > FAINT) | (loaded > FAINT))

    def with_poles(self, which: NDArray[np.bool_]) -> CondensedStructure:
        """Return the structure with some of its poles alone."""
        places = np.cumsum(which) - 1
        return replace(
            self,
            poles=self.poles[which],
            viscous=self.viscous[which],
            inertial=self.inertial[which],
            viscous_back=self.viscous_back[:, which],
            inertial_back=self.inertial_back[:, which],
            modes=self.modes[:, which],
            participation=self.participation[which],
            coupled=places[self.coupled[which[self.coupled]]],
        )

    def possible(self, orders: int) -> NDArray[np.bool_]:
        """Return which coordinates can move in orders 0, 1, …: all, (orders, rank)."""
        return np.ones((orders, len(self.stiffness)), dtype=bool)

    def dynamic_stiffness(
        self, variable: ComplexArray, wanted: NDArray[np.bool_] | None = None
    ) -> ComplexArray:
        """Return S(s), shape ``(orders, rank, rank)`` (theory, eq. 15).

        Parameters
        ----------
        variable
            Laplace variable s = ikω of each harmonic [rad/s], shape ``(orders,)``.
        wanted
            Which coordinates move at each order, shape ``(orders, rank)``; the rest of
            the result is zero. All of them if left out.
        """
        if wanted is None:
            wanted = np.ones((variable.size, len(self.stiffness)), dtype=bool)
        if len(self.stiffness) >= WIDE and wanted.all() and not self.gyroscopic:
            return np.array([self._whole(s) for s in variable])
        return dynamic_stiffness(
            self.stiffness,
            self.damping,
            self.mass,
            self.poles[self.coupled],
            *self._driven,
            variable,
            wanted,
            self.gyroscopic,
        )

    def slope(self, variable: ComplexArray, relative: ComplexArray) -> ComplexArray:
        """Return (dS/ds) y, shape ``(orders, rank)`` as ``relative`` is."""
        return stiffness_slope(
            self.damping,
            self.mass,
            self.poles[self.coupled],
            *self._driven,
            variable,
            relative,
        )

    def loading(self, force: ComplexArray) -> Loading:
        """Return how loads reach y; ``force`` [N] has shape (orders, dofs)."""
        modal, direct = force @ self.participation.T, force @ self.static

        def load(variable: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
            returned, change = returned_load(self.poles, *self._back, variable, modal)
            return direct + returned, change

        return load

    def motion(
        self, variable: ComplexArray, relative: ComplexArray, force: ComplexArray
    ) -> ComplexArray:
        """Return u from y and the loads, shape ``(orders, dofs)``."""
        s = variable[:, None]
        into = s * (relative @ self.viscous.T) + s**2 * (relative @ self.inertial.T)
        modal = (force @ self.participation.T - into) / (s - self.poles)
        moved: ComplexArray = relative @ self.static.T + modal @ self.modes.T
        if self.unheld.size:
            mobility = np.divide(1.0, s**2, np.zeros_like(s), where=s != 0.0)
            moved += mobility * (force @ self.unheld) @ self.unheld.T  # no mean
        return moved

    @cached_property
    def _driven(self) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
        """How the poles that y excites are coupled with it, by rows of y."""
        used = self.coupled
        return (
            self.viscous[used].T.copy(),
            self.inertial[used].T.copy(),
            self.viscous_back[:, used].copy(),
            self.inertial_back[:, used].copy(),
        )

    @cached_property
    def _back(self) -> tuple[ComplexArray, ComplexArray]:
        """How y is coupled with all poles, by rows."""
        return self.viscous_back.copy(), self.inertial_back.copy()

    def _whole(self, s: complex) -> ComplexArray:
        """Return S(s) of all coordinates by one product."""
        used = self.coupled
        pole = (s * s / (s - self.poles[used]))[:, None]
        into = (self.viscous[used] + s * self.inertial[used]) * pole
        back = self.viscous_back[:, used] + s * self.inertial_back[:, used]
        value: ComplexArray = (
            self.stiffness + s * (self.damping + s * self.mass) - back @ into
        )
        return value


def _share(rows: ComplexArray) -> Array:
    """Return the size of each row, its share of the largest."""
    sizes: Array = np.abs(rows).max(axis=1, initial=0.0)
    largest = sizes.max(initial=0.0)
    return sizes / largest if largest > 0.0 else sizes
