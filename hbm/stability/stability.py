"""Floquet multipliers of a periodic response (theory §6.4).

A small motion about the orbit is carried through a period in the coordinates of the
relative motion and modes of the structure with stuck contacts (Craig and Bampton,
1968). Where half a period later is a mirror image, half a period is enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.stability.carried import carried
from hbm.stability.carried_step import CarriedStructure
from hbm.stability.counting_modes import counting_modes
from hbm.stability.tangents import StepTangents, step_tangents
from hbm.structure.stuck_motions import stuck_motions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.problem import Problem

BEYOND = 1e150
"""modulus of half a period's multiplier that counts as any larger one"""


@dataclass(frozen=True)
class SmallMotions:
    """The structure for small motions: y first, then modal coordinates."""

    mass: Array
    """shape (coordinates, coordinates)"""
    damping: Array
    stiffness: Array
    basis: Array
    """map from y to the contact points, shape (3 points, rank)"""
    inertia: Array
    """what a sudden force on a contact point moves [kg], shape (3 points,)"""

    def multipliers(
        self, contact: AlternatingFrequencyTime, frequency: float
    ) -> ComplexArray:
        """Return the Floquet multipliers, the largest modulus first.

        Parameters
        ----------
        contact
            Just called at the orbit; its tangents are taken.
        frequency
            Of the orbit [rad/s].
        """
        if remembers(contact.points).any():
            from hbm.stability.recalled import recalled_multipliers

            matrices = self.mass, self.damping, self.stiffness
            given = matrices, self.basis, self.inertia
            return recalled_multipliers(*given, contact, frequency)
        signs = self._signs(contact)
        steps = step_tangents(
            contact, self.basis, self.inertia, frequency, half=signs is not None
        )
        found = [np.empty(0, complex)]  # what moves freely alone has none
        for family in self._families(steps.elastic, steps.viscous):
            if (family >= self.basis.shape[1]).all():
                found.append(self._untouched(family, frequency))
                continue
            carried = self._map(family, steps)
            if signs is None:
                values = np.linalg.eigvals(carried).astype(complex)
            else:
                mirrored = np.tile(signs[family], 2)[:, None] * carried
                half = np.linalg.eigvals(mirrored).astype(complex)
                values = (half / np.maximum(1.0, np.abs(half) / BEYOND)) ** 2
            found.append(values)
        together = np.concatenate(found)
        ordered: ComplexArray = together[np.argsort(-np.abs(together))]
        return ordered

    def _untouched(self, family: NDArray[np.int64], frequency: float) -> ComplexArray:
        """Return the multipliers of modes that no contact moves, by their poles."""
        square, none = np.ix_(family, family), np.zeros((family.size, family.size))
        rates = np.block(
            [
                [none, np.eye(family.size)],
                [-self.stiffness[square], -self.damping[square]],
            ]
        )
        powers = np.linalg.eigvals(rates) * (2.0 * np.pi / frequency)
        found: ComplexArray = np.exp(
            np.minimum(powers.real, 2.0 * np.log(BEYOND)) + 1j * powers.imag
        )
        return found

    def _map(self, family: NDArray[np.int64], steps: StepTangents) -> Array:
        """Return the map of the coupled coordinates of a family over all steps."""
        square = np.ix_(family, family)
        inner = family[family < self.basis.shape[1]]
        elastic, viscous = (
            np.ascontiguousarray(each[:, inner[:, None], inner])
            for each in (steps.elastic, steps.viscous)
        )
        mass, stiffness, rank = self.mass[square], self.stiffness[square], inner.size
        structure = CarriedStructure(
            np.ascontiguousarray(mass[:rank]),
            np.ascontiguousarray(mass[rank:, :rank]),
            np.ascontiguousarray(self.damping[square]),
            np.ascontiguousarray(stiffness[:rank, :rank]),
            stiffness.diagonal()[rank:].copy(),
        )
        return carried(structure, elastic, viscous, steps.lengths, steps.sticks)

    def _signs(self, contact: AlternatingFrequencyTime) -> Array | None:
        """Return by which signs the coordinates differ after half a period.

        None if there is no such symmetry of the contacts, or the structure has none.
        """
        partners, signs, _, _ = contact.symmetry
        if signs.size == 0:
            return None
        later = signs[:, None] * self.basis[partners]
        inner = np.where((later * self.basis).sum(axis=0) < 0.0, -1.0, 1.0)
        if not np.allclose(later, self.basis * inner, rtol=0.0, atol=1e-9):
            return None
        rank = inner.size
        coupling = self.mass[rank:, :rank]
        outer = np.where((coupling**2 * inner).sum(axis=1) < 0.0, -1.0, 1.0)
        both = np.append(inner, outer)
        mixed = self._coupling[np.outer(both, both) < 0.0]
        return both if mixed.max(initial=0.0) <= 1e-8 else None

    @cached_property
    def _coupling(self) -> Array:
        """How strongly coordinates are coupled, over their own inertia and the like."""
        found = np.zeros(self.mass.shape)
        for matrix in (self.mass, self.damping, self.stiffness):
            size = np.sqrt(np.abs(np.outer(matrix.diagonal(), matrix.diagonal())))
            size = np.maximum(size, 1e-200)
            found = np.maximum(found, np.abs(matrix) / size)
        return found

    def _families(self, elastic: Array, viscous: Array) -> list[NDArray[np.int64]]:
        """Return the coordinates that are coupled with each other."""
        rank = self.basis.shape[1]
        coupled = self._coupling > 1e-9
        for tangents in (elastic, viscous):
            size = np.abs(tangents).max(axis=0, initial=0.0)
            coupled[:rank, :rank] |= size > 1e-10 * size.max(initial=0.0)
        return _components(coupled.tobytes(), len(coupled))


@lru_cache(maxsize=64)
def _components(links: bytes, count: int) -> list[NDArray[np.int64]]:
    """Return the places that hang together, ``links`` being a matrix of booleans."""
    linked = np.frombuffer(links, dtype=bool).reshape(count, count)
    _, family = connected_components(linked)
    return [np.flatnonzero(family == each) for each in np.unique(family)]


def small_motions(problem: Problem) -> SmallMotions:
    """Return the structure of a problem for small motions about any orbit."""
    basis, selection = problem.interface.relative_motion()
    structure = problem.structure.dense
    static, free, _ = stuck_motions(structure, selection)
    stuck = [free.T @ matrix @ free for matrix in (structure.stiffness, structure.mass)]
    squares, shapes = scipy.linalg.eigh(*stuck)
    kept = counting_modes(structure, static, free @ shapes, squares)
    motion = np.hstack([static, free @ shapes[:, kept]])
    mass, damping, stiffness = (
        motion.T @ matrix @ motion
        for matrix in (structure.mass, structure.damping, structure.stiffness)
    )
    rank = basis.shape[1]
    mobility = np.linalg.inv(mass)[:rank, :rank]
    moves = ((basis @ mobility) * basis).sum(axis=1)
    inertia = np.divide(1.0, moves, out=np.full(moves.size, np.inf), where=moves > 0.0)
    return SmallMotions(mass, damping, stiffness, basis, inertia)
