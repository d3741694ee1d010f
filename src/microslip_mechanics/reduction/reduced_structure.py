"""A structure in few coordinates that keep what happens at some degrees of freedom."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.reduction.residual_vectors import residual_vectors
from microslip_mechanics.structures.factors import indefinite_factors
from microslip_mechanics.structures.projected_structure import projected
from microslip_mechanics.structures.structure import MATRICES, Structure
from microslip_mechanics.structures.stuck import stuck_structure
from microslip_mechanics.structures.stuck_modes import stuck_modes


@dataclass(frozen=True, slots=True)
class ReducedStructure:
    """A dense structure in place of a large one, u = shapes q."""

    whole: Structure
    structure: Structure
    """of the coordinates q"""
    shapes: Array
    """motion of each coordinate, shape (dofs, coordinates)"""
    interface: NDArray[np.int64]
    """degrees of freedom that are kept in view"""

    def rows(self, rows: Array) -> Array:
        """Return linear forms of the motion, (forms, dofs), as forms of q.

        A load on the whole structure is its transpose: ``rows(load)`` acts on q.
        """
        found: Array = rows @ self.shapes
        return found

    def error(self, frequency: float) -> float:
        """Return the measured error of what the interface meets.

        The dynamic stiffness without damping, condensed onto the interface, is computed
        from the whole structure at this frequency [rad/s], and its inverse, the motion
        that loads make. Their largest change, over their own size, is returned; each
        degree of freedom is scaled by its own stiffness. What is stiff hides in the
        one what is soft, which moves most, and in the other the other way round.

        Raises
        ------
        ValueError
            If the frequency is a natural one of the structure.
        """
        seen = np.zeros((self.interface.size, self.whole.dofs))
        seen[np.arange(self.interface.size), self.interface] = 1.0
        exact = _moved(self.whole, seen, frequency)
        found = _moved(self.structure, seen @ self.shapes, frequency)
        scale = np.sqrt(np.abs(np.diag(np.linalg.inv(exact))))
        exact, found = (np.outer(scale, scale) * each for each in (exact, found))
        pairs = (exact, found), (np.linalg.inv(exact), np.linalg.inv(found))
        return max(
            float(np.linalg.norm(there - here, 2) / np.linalg.norm(here, 2))
            for here, there in pairs
        )


def craig_bampton(
    structure: Structure, interface: NDArray[np.int64], highest: float
) -> ReducedStructure:
    """Return a structure whose coordinates are the interface and modes held there.

    Static responses to loads on the interface are exact.

    Parameters
    ----------
    structure
        Sparse or dense; held by its interface at the least.
    interface
        Degrees of freedom that stay coordinates, with their names.
    highest
        Modes of the structure held at the interface are kept up to here [rad/s].

    References
    ----------
    Craig, Bampton (1968), Coupling of substructures for dynamic analyses, AIAA J. 6.
    """
    selection = np.zeros((interface.size, structure.dofs))
    selection[np.arange(interface.size), interface] = 1.0
    stuck = stuck_structure(_sparse(structure), selection)
    modes = stuck_modes(stuck, highest)
    shapes = np.hstack([stuck.static, stuck.free @ modes.shapes])
    names = [structure.names[place] for place in interface]
    names += [f"fixed mode {place + 1}" for place in range(modes.squares.size)]
    small = projected(structure, shapes, interface.size, tuple(names))
    return ReducedStructure(structure, small, shapes, interface)


def modal_truncation(
    structure: Structure, interface: NDArray[np.int64], highest: float
) -> ReducedStructure:
    """Return a structure in its own modes, and what they miss of static responses.

    The slowest modes come first; then the residual responses to loads on the interface
    (MacNeal 1971, Rubin 1975), so that static responses to these are exact.

    Parameters
    ----------
    structure
        Sparse or dense; it must not move freely.
    interface
        Degrees of freedom on which contacts and loads act.
    highest
        Modes are kept up to here [rad/s].
    """
    stuck = stuck_structure(_sparse(structure), np.zeros((0, structure.dofs)))
    modes = stuck_modes(stuck, highest)
    loads = np.zeros((structure.dofs, interface.size))
    loads[interface, np.arange(interface.size)] = 1.0
    residual, _ = residual_vectors(stuck, modes, stuck.free.T @ loads)
    shapes = np.asarray(stuck.free @ np.hstack([modes.shapes, residual]))
    names = [f"mode {place + 1}" for place in range(modes.squares.size)]
    names += [f"residual {place + 1}" for place in range(residual.shape[1])]
    small = projected(structure, shapes, 0, tuple(names))
    return ReducedStructure(structure, small, shapes, interface)


def _sparse(structure: Structure) -> Structure:
    """Return the structure with sparse matrices."""
    if structure.sparse:
        return structure
    mass, damping, stiffness = (
        scipy.sparse.csc_array(getattr(structure, name)) for name in MATRICES
    )
    return Structure(mass, damping, stiffness, structure.names, structure.gyroscopic)


def _moved(structure: Structure, seen: Array, frequency: float) -> Array:
    """Return what unit loads move, both through ``seen``."""
    matrix: Matrix = structure.stiffness - frequency**2 * structure.mass
    found = indefinite_factors(matrix)
    if found is None:
        raise ValueError(
            f"{frequency:g} rad/s is a natural frequency of the structure: "
            "take another one"
        )
    moved: Array = seen @ found.solve(np.ascontiguousarray(seen.T))
    return moved
