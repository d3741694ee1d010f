"""A sparse structure whose contacts stick, and its static responses (theory §6.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse
from scipy.sparse.linalg import LinearOperator, aslinearoperator

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.structures.extended import extended_product
from microslip_mechanics.structures.factors import (
    Factors,
    factors,
    indefinite_factors,
)
from microslip_mechanics.structures.structure import Structure

DRIVEN = (
    "the stiffness of the structure drives it away while all contacts stick: it has a "
    "negative eigenvalue; hold that motion by a spring"
)
FREE = (
    "the structure can move freely while all contacts stick: hold it by a spring, a "
    "soft one perhaps, or give dense matrices"
)
NEGATIVE = 1e-9
"""pivot over the matrix's own diagonal element, from which on a negative one is more
than rounding makes of what moves freely"""


@dataclass(frozen=True, slots=True)
class StuckStructure:
    """u = static y + free w: w is what moves while y is held."""

    static: Array
    """T: static response to y, shape (dofs, rank)"""
    free: Matrix
    """sparse map from w, shape (dofs, dofs − rank)"""
    mass: Matrix
    """freeᵀ M free, sparse"""
    damping: Matrix
    """freeᵀ C free, sparse; a linear operator if C is one"""
    stiffness: Matrix
    """freeᵀ K free, sparse"""
    factors: Factors
    """of the stiffness"""


def stuck_structure(structure: Structure, selection: Array) -> StuckStructure:
    """Return a sparse structure that is held at y = selection u.

    Raises
    ------
    ValueError
        If it can move freely all the same, or if its stiffness drives it away.
    """
    direct, free = _null_basis(selection)
    mass, damping, stiffness = (
        _restricted(matrix, free)
        for matrix in (structure.mass, structure.damping, structure.stiffness)
    )
    found = factors(stiffness)
    if found is None:
        raise ValueError(DRIVEN if _driven(stiffness) else FREE)
    static = direct
    for _ in range(2):  # once more, for what rounding leaves
        held = free.T @ extended_product(structure.stiffness, static)
        static = static - free @ found.solve(held)
    return StuckStructure(static, free, mass, damping, stiffness, found)


def _driven(stiffness: Matrix) -> bool:
    """Return whether a sparse stiffness has a negative eigenvalue beyond rounding."""
    found = indefinite_factors(stiffness)
    if found is None:
        return False
    return bool((found.pivots < -NEGATIVE * np.abs(stiffness.diagonal())).any())


def _restricted(matrix: Matrix, free: Matrix) -> Matrix:
    """Return freeᵀ matrix free, sparse unless the matrix is a linear operator."""
    if isinstance(matrix, LinearOperator):
        return aslinearoperator(free.T.tocsc()) @ matrix @ aslinearoperator(free)
    return scipy.sparse.csc_array(free.T @ scipy.sparse.csc_array(matrix) @ free)


def _null_basis(selection: Array) -> tuple[Array, Matrix]:
    """Return D and a sparse Z with y = selection u for u = D y + Z w, any w.

    As many degrees of freedom as y has coordinates follow from the others; a QR
    factorisation with pivots chooses them among those that y sees.
    """
    rank, dofs = selection.shape
    touched = np.flatnonzero(selection.any(axis=0))
    if rank == 0:
        return np.zeros((dofs, 0)), scipy.sparse.eye_array(dofs, format="csc")
    order = scipy.linalg.qr(selection[:, touched], mode="r", pivoting=True)[1]
    following, leading = touched[order[:rank]], touched[order[rank:]]
    inverse = np.linalg.inv(selection[:, following])
    direct = np.zeros((dofs, rank))
    direct[following] = inverse
    block = -inverse @ selection[:, leading]
    rows, columns = np.nonzero(np.abs(block) > 1e-14 * np.abs(block).max(initial=0.0))
    kept = np.delete(np.arange(dofs), following)
    place = np.empty(dofs, dtype=int)
    place[kept] = np.arange(kept.size)
    values = np.concatenate([np.ones(kept.size), block[rows, columns]])
    where = (
        np.concatenate([kept, following[rows]]),
        np.concatenate([place[kept], place[leading[columns]]]),
    )
    return direct, scipy.sparse.csc_array((values, where), shape=(dofs, kept.size))
