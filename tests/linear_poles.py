"""Poles of a structure without contacts, and an order in which to compare them."""

import numpy as np

from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.structures.structure import Structure


def poles(structure: Structure) -> ComplexArray:
    """Return the eigenvalues of the state matrix [1/s], shape (2 dofs,)."""
    dofs = structure.dofs
    block = np.hstack([structure.stiffness, structure.damping])
    below = -np.linalg.solve(structure.mass, block)
    found: ComplexArray = np.linalg.eigvals(
        np.vstack([np.eye(dofs, 2 * dofs, dofs), below])
    )
    return found


def in_order(values: ComplexArray) -> ComplexArray:
    """Return values in an order that rounding does not change."""
    return values[np.lexsort((values.imag, values.real.round(8)))]
