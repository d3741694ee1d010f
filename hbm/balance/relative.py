"""A problem in the relative coordinates of its contacts (theory §6.1)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis
from hbm.structure.condensed import Condensed
from hbm.structure.tractions import Tractions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.floating import Floating
from microslip_mechanics.contact.points import ContactPoints


@dataclass(frozen=True, slots=True)
class RelativeProblem:
    """What harmonic balance solves, in coordinates y of the relative motion."""

    points: ContactPoints
    basis: Array
    """map from y to the points, shape (3 points, rank)"""
    selection: Array
    """map from the structure to y, shape (rank, dofs)"""
    offset: Array
    """constant displacement of the points besides y [m], shape (3 points,)"""
    condensed: Condensed
    force: ComplexArray
    """preload and −i drive: the loads of orders 0 and 1 [N], shape (2, dofs)"""
    loose: Array
    """mean motions that nothing but friction holds, orthonormal, (rank, motions)"""
    gauge: Array
    """stiffness that pins them [N/m], shape (rank, rank)"""
    rest: Array
    """y at rest [m], shape (rank,)"""
    position: Array
    """constant motion of the structure besides that by y and the loads [m], (dofs,)"""
    odd: NDArray[np.bool_] | None = None
    """which coordinates have odd harmonics only, the others even ones; None if mixed"""
    pruned: bool = True
    """whether tangents that the contacts' laws do not have are left out"""
    tractions: Tractions | None = None
    """of rigid contacts: pushes on them are the last coordinates"""
    bent: Array | None = None
    """by how much sliders that never slip are bent in the mean [m], (points, 3); none
    of them is if left out"""

    @property
    def rank(self) -> int:
        """Number of relative coordinates."""
        return int(self.basis.shape[1])

    def contact(self, fourier: FourierBasis) -> AlternatingFrequencyTime:
        """Return the contacts evaluated with a number of harmonics and samples."""
        return AlternatingFrequencyTime(
            self.points,
            self.basis,
            fourier,
            offset=self.offset,
            odd=self.odd,
            pruned=self.pruned,
            floating=self.floating,
        )

    @property
    def floating(self) -> Floating | None:
        """How far what only friction holds has moved from rest; None if all is held.

        And how sliders are bent, if some are.
        """
        if not self.loose.size and self.bent is None:
            return None
        bent = 0.0 if self.bent is None else self.bent
        place = self.basis @ self.rest + self.offset
        return Floating(self.basis @ self.loose, place, bent)

    def smoothed(self, threshold: float) -> RelativeProblem:
        """Return the problem with no threshold velocity below the given one [m/s]."""
        if threshold == 0.0:
            return self
        least = np.maximum(self.points.threshold, threshold)
        return replace(self, points=self.points._replace(threshold=least))

    def first_harmonic(
        self, relative: ComplexArray, frequencies: Array, rows: Array
    ) -> ComplexArray:
        """Return order 1 of linear forms of the motion [m].

        ``relative`` is order 1 of y in several motions at about one frequency, shape
        ``(motions, rank)``; ``rows`` has shape ``(forms, dofs)``, the result
        ``(motions, forms)``.
        """
        motion = self.condensed.motion(1j * frequencies, relative, self.force[1:])
        seen: ComplexArray = motion @ rows.T
        return seen

    def apart(self, frequency: float) -> ComplexArray:
        """Return order 1 of the points' motion if there were no contacts [m].

        Its shape is ``(3 points,)``.
        """
        seen: ComplexArray = self.basis @ self.moved_apart(frequency)
        return seen

    def moved_apart(self, frequency: float) -> ComplexArray:
        """Return order 1 of y if there were no contacts [m], shape (rank,)."""
        variable = np.array([1j * frequency])
        load, _ = self.condensed.loading(self.force[1:])(variable)
        stiffness = self.condensed.dynamic_stiffness(variable)
        moved: ComplexArray = np.linalg.lstsq(stiffness[0], load[0], rcond=None)[0]
        return moved

    def map_from(self, displacement: Array) -> Array:
        """Return the map from a structure to y, shape (rank, dofs).

        ``displacement`` is its map to the points, shape ``(3 points, dofs)``. What is
        not seen in a motion, pushes on rigid contacts, has rows of zeros.
        """
        if self.tractions is None:
            return self.basis.T @ displacement
        rows, places = self.tractions.rows, self.tractions.places
        others = self.basis[:, : rows.shape[1]].T @ displacement
        seen = others + rows.T @ displacement[places]
        return np.pad(seen, ((0, len(rows)), (0, 0)))

    def restricted(
        self, kept: NDArray[np.int64], odd: NDArray[np.bool_] | None
    ) -> RelativeProblem:
        """Return the problem for some coordinates, the others staying at rest."""
        left = np.setdiff1d(np.arange(self.rank), kept)
        return replace(
            self,
            basis=np.ascontiguousarray(self.basis[:, kept]),
            selection=self.selection[kept],
            offset=self.offset + self.basis[:, left] @ self.rest[left],
            condensed=self.condensed.restricted(kept, self.force),
            loose=self.loose[kept],
            gauge=self.gauge[np.ix_(kept, kept)],
            rest=self.rest[kept],
            position=self.position + self.condensed.static[:, left] @ self.rest[left],
            odd=odd,
            tractions=self.tractions and self.tractions.restricted(kept),
        )
