"""Floquet multipliers of a periodic response (theory §6).

A small motion about the orbit is carried through a period in the coordinates of the
relative motion and modes of the structure with stuck contacts (Craig and Bampton,
1968). Where half a period later is a mirror image, half a period is enough.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import NamedTuple

import numpy as np
import scipy.linalg
from numpy.typing import NDArray
from scipy.sparse.csgraph import connected_components

from hbm.aft import AlternatingFrequencyTime
from hbm.recalled import recalled_multipliers
from hbm.stuck_poles import split
from hbm.tangents import StepTangents, step_tangents
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.jit import bare_kernel, kernel
from microslip_mechanics.problem import Problem

SMALLEST = 0.004
"""root of a stuck mode's part in the inertia of y, by mass or by dashpots, over its
frequency, relative to the largest of all modes; what has less is left out"""

BEYOND = 1e150
"""modulus of half a period's multiplier that counts as any larger one"""
ROOT = 3.0 + 1j * np.sqrt(3.0)
FACTOR = 12.0 * ROOT / (2j * ROOT.imag)
STICKING_ROOT = 2.0 + 1j * np.sqrt(2.0)
STICKING_FACTOR = (3.0 + STICKING_ROOT) / (1j * STICKING_ROOT.imag)
"""poles ρ and residues a of the Padé approximations (2, 2) and (1, 2)"""


class Structure(NamedTuple):
    """Coordinates y and modes of a structure; nothing elastic couples them."""

    mass: Array
    """rows of y, shape (rank, rank + modes)"""
    coupling: Array
    """mass of the modes by y, shape (modes, rank); that of the modes is one"""
    damping: Array
    """shape (rank + modes, rank + modes)"""
    stiffness: Array
    """of y, shape (rank, rank)"""
    squares: Array
    """of the modes' frequencies [rad²/s²], shape (modes,)"""


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
            matrices = self.mass, self.damping, self.stiffness
            return recalled_multipliers(matrices, self.basis, contact, frequency)
        signs = self._signs(contact)
        steps = step_tangents(
            contact, self.basis, self.inertia, frequency, half=signs is not None
        )
        found = []
        for family in self._families(steps.elastic, steps.viscous):
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

    def _map(self, family: NDArray[np.int64], steps: StepTangents) -> Array:
        """Return the map of the coupled coordinates of a family over all steps."""
        square = np.ix_(family, family)
        inner = family[family < self.basis.shape[1]]
        elastic, viscous = (
            np.ascontiguousarray(each[:, inner[:, None], inner])
            for each in (steps.elastic, steps.viscous)
        )
        mass, stiffness, rank = self.mass[square], self.stiffness[square], inner.size
        structure = Structure(
            np.ascontiguousarray(mass[:rank]),
            np.ascontiguousarray(mass[rank:, :rank]),
            np.ascontiguousarray(self.damping[square]),
            np.ascontiguousarray(stiffness[:rank, :rank]),
            stiffness.diagonal()[rank:].copy(),
        )
        return _carried(structure, elastic, viscous, steps.lengths, steps.sticks)

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
    static, free = split(structure.stiffness, selection)
    stuck = [free.T @ matrix @ free for matrix in (structure.stiffness, structure.mass)]
    squares, shapes = scipy.linalg.eigh(*stuck)
    inertia = static.T @ structure.mass @ static
    coupling = shapes.T @ free.T @ structure.mass @ static
    dashpots = shapes.T @ free.T @ structure.damping @ static
    part: Array = sum(
        (each.T * scipy.linalg.solve(inertia, each.T)).sum(axis=0) / scale
        for each, scale in ((coupling, 1.0), (dashpots, squares))
    )
    weight = np.sqrt(np.maximum(part, 0.0) / squares)
    kept = weight >= SMALLEST * weight.max(initial=0.0)
    if structure.gyroscopic:  # Coriolis terms couple modes that inertia does not
        kept[:] = True
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


@kernel
def _carried(
    structure: Structure,
    elastic: Array,
    viscous: Array,
    lengths: Array,
    sticks: NDArray[np.bool_],
) -> Array:
    """Return the map of (displacement, velocity) over all steps.

    ``elastic`` and ``viscous`` are the tangents during each step, shape
    ``(steps, rank, rank)``. The exponential of a step is its Padé approximation (2, 2),
    x + 2 Re a (hA − ρ)⁻¹ x, or, where a contact begins to stick, (1, 2),
    2 Re a (hA − ρ)⁻¹ x, which lets no speed through.
    """
    rank, count = structure.mass.shape
    moved, moving = np.eye(count, 2 * count), np.zeros((count, 2 * count))
    for i in range(count):
        moving[i, count + i] = 1.0
    stage = np.empty((count, 2 * count), dtype=np.complex128)
    inner, outer = stage[:rank], stage[rank:]
    step, root = 0.0, ROOT
    parts = _eliminated(structure, 1.0, root)
    for place in range(lengths.size):
        wanted = STICKING_ROOT if sticks[place] else ROOT
        # lengths of equal intervals differ by rounding
        if root != wanted or abs(step - lengths[place]) > 1e-9 * step:
            step, root = lengths[place], wanted
            parts = _eliminated(structure, step, root)
        inverse, lowered, raised, matrix = parts
        stiffness = structure.stiffness + elastic[place]
        holding = matrix + (step * step / root) * elastic[place] + step * viscous[place]
        _loads(structure, stiffness, moved, moving, step / root, stage)
        free = np.dot(inverse, outer)
        inner[:] = np.linalg.solve(holding, inner - np.dot(raised, outer))
        outer[:] = free - np.dot(lowered, inner)
        if sticks[place]:
            _advance(moved, moving, stage, step, root, STICKING_FACTOR, 0.0)
        else:
            _advance(moved, moving, stage, step, root, FACTOR, 1.0)
    return np.concatenate((moved, moving))


@kernel
def _eliminated(
    structure: Structure, step: float, root: complex
) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
    """Return what the modes leave of h²K/ρ + hC + ρM, in a step without contact.

    They are the inverse of the modes' block, that times the column of y, the row of y
    times it, and the block of y without what goes through the modes.
    """
    rank = structure.mass.shape[0]
    squares, damping = structure.squares, structure.damping
    modes = (step * damping[rank:, rank:]).astype(np.complex128)
    for mode in range(squares.size):
        modes[mode, mode] += step * step * squares[mode] / root + root
    inverse = np.linalg.inv(modes)
    coupling = np.ascontiguousarray(structure.mass[:, rank:])
    column = step * damping[rank:, :rank] + root * coupling.T
    row = step * damping[:rank, rank:] + root * coupling
    raised = np.dot(row, inverse)
    matrix = (step * step / root) * structure.stiffness + step * damping[:rank, :rank]
    matrix = matrix + root * structure.mass[:, :rank] - np.dot(raised, column)
    return inverse, np.dot(inverse, column), raised, matrix


@kernel
def _loads(
    structure: Structure,
    stiffness: Array,
    moved: Array,
    moving: Array,
    factor: complex,
    result: ComplexArray,
) -> None:
    """Write (h/ρ) K u − M u̇."""
    rank = stiffness.shape[0]
    elastic = np.dot(stiffness, moved[:rank])
    inertial = np.dot(structure.mass, moving)
    coupled = np.dot(structure.coupling, moving[:rank])
    for row in range(rank):
        for column in range(moved.shape[1]):
            result[row, column] = factor * elastic[row, column] - inertial[row, column]
    for mode in range(structure.squares.size):
        row, share = rank + mode, factor * structure.squares[mode]
        for column in range(moved.shape[1]):
            inertia = coupled[mode, column] + moving[row, column]
            result[row, column] = share * moved[row, column] - inertia


@bare_kernel
def _advance(
    moved: Array,
    moving: Array,
    stage: ComplexArray,
    step: float,
    root: complex,
    factor: complex,
    kept: float,
) -> None:
    """Bring displacement and velocity to the end of a step; ``stage`` is (hA − ρ)⁻¹."""
    share = factor / root
    rest, length = kept - 2.0 * share.real, 2.0 * step * share
    for row in range(moved.shape[0]):
        for column in range(moved.shape[1]):
            speed = stage[row, column]
            change = length.real * speed.real - length.imag * speed.imag
            moved[row, column] = rest * moved[row, column] + change
            change = factor.real * speed.real - factor.imag * speed.imag
            moving[row, column] = kept * moving[row, column] + 2.0 * change
