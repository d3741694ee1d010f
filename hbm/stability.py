"""Floquet multipliers of a periodic response (theory §6).

A small motion about the orbit is carried through a period in the coordinates of the
relative motion and modes of the structure with stuck contacts (Craig and Bampton,
1968). Where half a period later is a mirror image, half a period is enough.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from hbm.aft import AlternatingFrequencyTime
from hbm.condensation import split
from hbm.tangents import StepTangents, step_tangents
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import kernel
from microslip_mechanics.problem import Problem

SMALLEST = 0.004
"""part of a stuck mode in the inertia of y, over its frequency, relative to the largest
of all modes; what has less is left out"""


@dataclass(frozen=True, slots=True)
class SmallMotions:
    """The structure for small motions: y first, then modal coordinates."""

    mass: Array
    """shape (coordinates, coordinates)"""
    damping: Array
    stiffness: Array
    basis: Array
    """map from y to the contact points, shape (3 points, rank)"""

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
        signs = self._signs(contact)
        steps = step_tangents(contact, self.basis, frequency, half=signs is not None)
        found = []
        for family in self._families(steps.elastic, steps.viscous):
            carried = self._map(family, steps)
            if signs is None:
                values = np.linalg.eigvals(carried).astype(complex)
            else:
                mirrored = np.tile(signs[family], 2)[:, None] * carried
                values = np.linalg.eigvals(mirrored).astype(complex) ** 2
            found.append(values)
        together = np.concatenate(found)
        ordered: ComplexArray = together[np.argsort(-np.abs(together))]
        return ordered

    def _map(self, family: NDArray[np.int64], steps: StepTangents) -> Array:
        """Return the map of the coupled coordinates of a family over all steps."""
        square = np.ix_(family, family)
        inner = family[family < self.basis.shape[1]]
        elastic, viscous = (
            np.ascontiguousarray(each[:, inner[:, None], inner])
            for each in (steps.elastic, steps.viscous)
        )
        structure = (self.mass[square], self.damping[square], self.stiffness[square])
        return _carried(*structure, elastic, viscous, steps.lengths)

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
        for matrix in (self.mass, self.damping, self.stiffness):
            size = np.sqrt(np.abs(np.outer(matrix.diagonal(), matrix.diagonal())))
            odd = np.abs(matrix) * (np.outer(both, both) < 0.0)
            if np.any(odd > 1e-8 * size + 1e-300):
                return None
        return both

    def _families(self, elastic: Array, viscous: Array) -> list[NDArray[np.int64]]:
        """Return the coordinates that are coupled with each other."""
        rank = self.basis.shape[1]
        coupled = np.zeros(self.mass.shape, dtype=bool)
        for matrix in (self.mass, self.damping, self.stiffness):
            size = np.sqrt(np.abs(np.outer(matrix.diagonal(), matrix.diagonal())))
            coupled |= np.abs(matrix) > 1e-9 * size + 1e-300
        for tangents in (elastic, viscous):
            size = np.abs(tangents).max(axis=0, initial=0.0)
            coupled[:rank, :rank] |= size > 1e-10 * size.max(initial=0.0)
        _, family = connected_components(coupled)
        return [np.flatnonzero(family == each) for each in np.unique(family)]


def small_motions(problem: Problem) -> SmallMotions:
    """Return the structure of a problem for small motions about any orbit."""
    basis, selection = problem.interface.relative_motion()
    structure = problem.structure.dense
    static, free = split(structure.stiffness, selection)
    stuck = [free.T @ matrix @ free for matrix in (structure.stiffness, structure.mass)]
    squares, shapes = scipy.linalg.eigh(*stuck)
    inertia = static.T @ structure.mass @ static
    coupling = shapes.T @ free.T @ structure.mass @ static
    part = (coupling.T * scipy.linalg.solve(inertia, coupling.T)).sum(axis=0)
    weight = np.sqrt(np.maximum(part, 0.0) / squares)
    kept = weight >= SMALLEST * weight.max(initial=0.0)
    motion = np.hstack([static, free @ shapes[:, kept]])
    mass, damping, stiffness = (
        motion.T @ matrix @ motion
        for matrix in (structure.mass, structure.damping, structure.stiffness)
    )
    return SmallMotions(mass, damping, stiffness, basis)


@kernel
def _carried(
    mass: Array,
    damping: Array,
    stiffness: Array,
    elastic: Array,
    viscous: Array,
    lengths: Array,
) -> Array:
    """Return the map of (displacement, velocity) over all steps.

    ``elastic`` and ``viscous`` are the tangents during each step, shape
    ``(steps, rank, rank)``; they act on the first coordinates. The exponential of a
    step is its Padé approximation (2, 2): x + 2 Re a (hA − ρ)⁻¹ x.
    """
    count, rank = mass.shape[0], elastic.shape[1]
    root = 3.0 + 1j * np.sqrt(3.0)
    factor = 12.0 * root / (root - np.conj(root))
    moved, moving = np.eye(count, 2 * count), np.zeros((count, 2 * count))
    for i in range(count):
        moving[i, count + i] = 1.0
    for place in range(lengths.size):
        step = lengths[place]
        rubbing, holding = damping.copy(), stiffness.copy()
        rubbing[:rank, :rank] += viscous[place]
        holding[:rank, :rank] += elastic[place]
        matrix = step * holding + root * rubbing + (root * root / step) * mass
        right = (-root / step) * np.dot(mass, moved)
        right -= np.dot(mass, moving) + np.dot(rubbing, moved)
        shift = np.linalg.solve(matrix, right)
        speed = (moved + root * shift) / step
        moved = moved + 2.0 * (factor * shift).real
        moving = moving + 2.0 * (factor * speed).real
    result = np.empty((2 * count, 2 * count))
    result[:count], result[count:] = moved, moving
    return result
