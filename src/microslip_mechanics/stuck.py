"""A sparse structure whose contacts stick: static responses and modes (theory §6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
import scipy.sparse
from scipy.sparse.linalg import LinearOperator, aslinearoperator, eigsh

from microslip_mechanics.arrays import Array, Matrix
from microslip_mechanics.extended import extended_product
from microslip_mechanics.factors import Factors, factors, indefinite_factors
from microslip_mechanics.structure import Structure

SMALL = 400
"""so many degrees of freedom have all their modes by a dense solution"""
MORE, MOST = 8, 1024
"""modes sought beyond the expected ones, and at the most"""


@dataclass(frozen=True, slots=True)
class StuckModes:
    """The slowest undamped modes."""

    squares: Array
    """of their frequencies [rad²/s²], shape (modes,)"""
    shapes: Array
    """of unit mass, shape (free, modes)"""
    next: float
    """frequency of the slowest mode left out [rad/s]; infinite if there is none, zero
    if it is not known"""


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

    def modes(self, cutoff: float) -> StuckModes:
        """Return the modes up to a frequency [rad/s].

        Raises
        ------
        ValueError
            If there are too many.
        """
        if cutoff == 0.0:
            return StuckModes(np.zeros(0), np.zeros((self.mass.shape[0], 0)), 0.0)
        size, count = self.mass.shape[0], min(self._expected(cutoff) + MORE, MOST)
        while True:
            squares, shapes = self.slowest(count)
            kept = int((squares <= cutoff**2).sum())
            if kept < squares.size or squares.size == size:
                left = np.sqrt(squares[kept]) if kept < size else np.inf
                return StuckModes(squares[:kept], shapes[:, :kept], float(left))
            if count >= MOST:
                raise ValueError(
                    f"the structure has more than {count} modes below {cutoff:.6g} "
                    "rad/s while its contacts stick: give a lower highest frequency"
                )
            count = min(2 * count, MOST)

    def _expected(self, cutoff: float) -> int:
        """Return the number of modes below a frequency [rad/s], as far as pivots tell.

        Their signs are right but for rounding, which pivots on the diagonal let grow.
        """
        found = indefinite_factors(self.stiffness - cutoff**2 * self.mass)
        return 0 if found is None else int((found.pivots < 0.0).sum())

    def slowest(self, count: int) -> tuple[Array, Array]:
        """Return squares and shapes of the slowest modes, ``count`` at the least.

        All of them by a dense solution where that is cheap, else by Lanczos' method.
        """
        shape = self.mass.shape
        if shape[0] <= max(SMALL, 2 * count):
            return scipy.linalg.eigh(self.stiffness.toarray(), self.mass.toarray())
        squares, shapes = eigsh(
            self.stiffness,
            count,
            self.mass,
            sigma=0.0,
            OPinv=LinearOperator(shape, matvec=self.factors.solve, dtype=float),
            v0=_start(shape[0]),
        )
        order = np.argsort(squares)
        return squares[order], shapes[:, order]

    def loss(self, modes: StuckModes) -> float:
        """Return the largest ratio of damping to stiffness beside some modes [s]."""
        if not isinstance(self.damping, LinearOperator) and self.damping.nnz == 0:
            return 0.0
        momenta = self.mass @ modes.shapes
        own = modes.shapes.T @ (self.damping @ modes.shapes)

        def damped(motion: Array) -> Array:
            motion = motion.ravel()
            share: Array = momenta @ (own @ (momenta.T @ motion))
            return np.asarray(self.damping @ motion) - share

        shape = self.mass.shape
        if shape[0] <= SMALL:
            share = momenta @ own @ momenta.T
            lossy = self.damping @ np.eye(shape[0]) - share
            return max(0.0, float(_largest(lossy, self.stiffness.toarray())))
        largest = eigsh(
            LinearOperator(shape, matvec=damped, dtype=float),
            1,
            self.stiffness,
            which="LA",
            Minv=LinearOperator(shape, matvec=self.factors.solve, dtype=float),
            v0=_start(shape[0]),
            tol=1e-3,
            return_eigenvectors=False,
        )
        return max(0.0, float(largest[0]))


def _largest(matrix: Array, beside: Array) -> float:
    """Return the largest eigenvalue of a dense symmetric pair."""
    last = len(matrix) - 1
    found = scipy.linalg.eigh(
        matrix, beside, eigvals_only=True, subset_by_index=(last, last)
    )
    return float(found[0])


def stuck_structure(structure: Structure, selection: Array) -> StuckStructure:
    """Return a sparse structure that is held at y = selection u.

    Raises
    ------
    ValueError
        If it can move freely all the same.
    """
    direct, free = _null_basis(selection)
    mass, damping, stiffness = (
        _restricted(matrix, free)
        for matrix in (structure.mass, structure.damping, structure.stiffness)
    )
    found = factors(stiffness)
    if found is None:
        raise ValueError(
            "the structure can move freely while all contacts stick: hold it by a "
            "spring, a soft one perhaps, or give dense matrices"
        )
    static = direct
    for _ in range(2):  # once more, for what rounding leaves
        held = free.T @ extended_product(structure.stiffness, static)
        static = static - free @ found.solve(held)
    return StuckStructure(static, free, mass, damping, stiffness, found)


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


def _start(size: int) -> Array:
    """Return the first vector of Lanczos' method, the same each time."""
    return np.random.default_rng(0).normal(size=size)
