"""Floquet multipliers of a periodic response (theory §6).

A small motion about the orbit is carried through a period in the coordinates of the
relative motion and the lowest modes of the structure with stuck contacts (Craig and
Bampton, 1968). The contact tangents are those that harmonic balance has at its samples.
A step is of fourth order and keeps what is damped damped.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from hbm.aft import AlternatingFrequencyTime
from hbm.condensation import split
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import kernel
from microslip_mechanics.problem import Problem

STEPS = 128
"""per period, about"""
HIGHEST = 12.0
"""modes are kept up to this multiple of the lowest one of the stuck structure …"""
FEWEST = 6
"""… and at least so many"""


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
        elastic, viscous = contact.relative_tangents(self.basis)
        elastic, viscous = (_regular(each) for each in (elastic, viscous))
        step = 2.0 * np.pi / frequency / len(elastic)
        found = []
        for family in self._families(elastic, viscous):
            square = np.ix_(family, family)
            inner = family[family < self.basis.shape[1]]
            carried = _carried(
                self.mass[square],
                self.damping[square],
                self.stiffness[square],
                np.ascontiguousarray(elastic[:, inner[:, None], inner]),
                np.ascontiguousarray(viscous[:, inner[:, None], inner]),
                step,
            )
            found.append(np.linalg.eigvals(carried).astype(complex))
        values = np.concatenate(found)
        ordered: ComplexArray = values[np.argsort(-np.abs(values))]
        return ordered

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
    kept = np.sqrt(squares) <= HIGHEST * np.sqrt(squares[:1])
    kept[:FEWEST] = True
    motion = np.hstack([static, free @ shapes[:, kept]])
    mass, damping, stiffness = (
        motion.T @ matrix @ motion
        for matrix in (structure.mass, structure.damping, structure.stiffness)
    )
    return SmallMotions(mass, damping, stiffness, basis)


def _regular(tangents: Array) -> Array:
    """Return tangents, (samples, rank, rank), at about :data:`STEPS` samples."""
    samples = len(tangents)
    if samples < STEPS:
        return tangents.repeat(-(-STEPS // samples), axis=0)
    size = samples // STEPS
    while samples % size:
        size -= 1
    mean: Array = tangents.reshape(-1, size, *tangents.shape[1:]).mean(axis=1)
    return mean


@kernel
def _carried(
    mass: Array,
    damping: Array,
    stiffness: Array,
    elastic: Array,
    viscous: Array,
    step: float,
) -> Array:
    """Return the map of (displacement, velocity) over all samples.

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
    heavy = mass.astype(np.complex128)
    rate = damping + root / step * mass
    constant = step * stiffness + root * rate
    for place in range(elastic.shape[0]):
        matrix, slow = constant.copy(), rate.copy()
        for i in range(rank):
            for j in range(rank):
                slow[i, j] += viscous[place, i, j]
                matrix[i, j] += (
                    step * elastic[place, i, j] + root * viscous[place, i, j]
                )
        right = -np.dot(heavy, moving.astype(np.complex128))
        right -= np.dot(slow, moved.astype(np.complex128))
        shift = np.linalg.solve(matrix, right)
        speed = (moved + root * shift) / step
        moved = moved + 2.0 * (factor * shift).real
        moving = moving + 2.0 * (factor * speed).real
    result = np.empty((2 * count, 2 * count))
    result[:count], result[count:] = moved, moving
    return result
