"""The slowest modes of a sparse structure whose contacts stick (theory §6.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from scipy.sparse.linalg import LinearOperator, eigsh

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.factors import indefinite_factors
from microslip_mechanics.structures.stuck import StuckStructure

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


def stuck_modes(stuck: StuckStructure, cutoff: float) -> StuckModes:
    """Return the modes up to a frequency [rad/s].

    Raises
    ------
    ValueError
        If there are too many.
    """
    if cutoff == 0.0:
        return StuckModes(np.zeros(0), np.zeros((stuck.mass.shape[0], 0)), 0.0)
    size, count = stuck.mass.shape[0], min(_expected(stuck, cutoff) + MORE, MOST)
    while True:
        squares, shapes = slowest(stuck, count)
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


def _expected(stuck: StuckStructure, cutoff: float) -> int:
    """Return the number of modes below a frequency [rad/s], as far as pivots tell.

    Their signs are right but for rounding, which pivots on the diagonal let grow.
    """
    found = indefinite_factors(stuck.stiffness - cutoff**2 * stuck.mass)
    return 0 if found is None else int((found.pivots < 0.0).sum())


def slowest(stuck: StuckStructure, count: int) -> tuple[Array, Array]:
    """Return squares and shapes of the slowest modes, ``count`` at the least.

    All of them by a dense solution where that is cheap, else by Lanczos' method.
    """
    shape = stuck.mass.shape
    if shape[0] <= max(SMALL, 2 * count):
        return scipy.linalg.eigh(stuck.stiffness.toarray(), stuck.mass.toarray())
    squares, shapes = eigsh(
        stuck.stiffness,
        count,
        stuck.mass,
        sigma=0.0,
        OPinv=LinearOperator(shape, matvec=stuck.factors.solve, dtype=float),
        v0=_start(shape[0]),
    )
    order = np.argsort(squares)
    return squares[order], shapes[:, order]


def loss_beside(stuck: StuckStructure, modes: StuckModes) -> float:
    """Return the largest ratio of damping to stiffness beside some modes [s]."""
    if not isinstance(stuck.damping, LinearOperator) and stuck.damping.nnz == 0:
        return 0.0
    momenta = stuck.mass @ modes.shapes
    own = modes.shapes.T @ (stuck.damping @ modes.shapes)

    def damped(motion: Array) -> Array:
        motion = motion.ravel()
        share: Array = momenta @ (own @ (momenta.T @ motion))
        return np.asarray(stuck.damping @ motion) - share

    shape = stuck.mass.shape
    if shape[0] <= SMALL:
        share = momenta @ own @ momenta.T
        lossy = stuck.damping @ np.eye(shape[0]) - share
        return max(0.0, float(_largest(lossy, stuck.stiffness.toarray())))
    largest = eigsh(
        LinearOperator(shape, matvec=damped, dtype=float),
        1,
        stuck.stiffness,
        which="LA",
        Minv=LinearOperator(shape, matvec=stuck.factors.solve, dtype=float),
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


def _start(size: int) -> Array:
    """Return the first vector of Lanczos' method, the same each time."""
    return np.random.default_rng(0).normal(size=size)
