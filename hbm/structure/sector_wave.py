"""One sector for one number of nodal diameters: what its contacts see (theory §6.6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.cyclic import CyclicProblem

HELD = 1e-9
"""relative size below which a contact does not see a wave"""


@dataclass(frozen=True, slots=True)
class Wave:
    """The sector for one number of nodal diameters: u = T y + N z."""

    sees: NDArray[np.int64]
    """relative coordinates that such a wave moves"""
    matrices: tuple[ComplexArray, ComplexArray, ComplexArray]
    """K, C, M of the sector"""
    static: ComplexArray
    """T, shape (dofs, seen)"""
    free: ComplexArray
    """N, shape (dofs, stuck)"""

    def ways(
        self, s: complex
    ) -> tuple[ComplexArray, ComplexArray, ComplexArray, ComplexArray]:
        """Return u from y, y's load from a load, K + sC + s²M and its derivative by s.

        Shapes (dofs, seen), (seen, dofs) and twice (dofs, dofs).
        """
        whole, slope = self._whole(s)
        back = self.free.conj().T
        inner = back @ whole @ self.free
        into = self.static - self.free @ np.linalg.solve(
            inner, back @ whole @ self.static
        )
        left = self.static.conj().T
        out = left - np.linalg.solve(inner.T, (left @ whole @ self.free).T).T @ back
        return into, out, whole, slope

    def stuck(self, s: complex, force: ComplexArray) -> ComplexArray:
        """Return the motion under a load while y is held, shape (dofs,)."""
        whole, _ = self._whole(s)
        back = self.free.conj().T
        motion: ComplexArray = self.free @ np.linalg.solve(
            back @ whole @ self.free, back @ force
        )
        return motion

    def _whole(self, s: complex) -> tuple[ComplexArray, ComplexArray]:
        stiffness, damping, mass = self.matrices
        return stiffness + s * damping + s * s * mass, damping + 2.0 * s * mass


def sector_wave(
    problem: CyclicProblem, own: Array, following: Array, angle: float
) -> Wave:
    """Return the sector for a wave in which the next one is ahead by ``angle``.

    The contacts see the sector by ``own`` and the next by ``following``, both of shape
    ``(rank, dofs)``.

    Raises
    ------
    ValueError
        If the contacts see a wave in part only, or the sector is free while they stick.
    """
    rows = own + np.exp(1j * angle) * following
    sizes = np.linalg.norm(rows, axis=1)
    largest = float(np.abs(own).max(initial=0.0) + np.abs(following).max(initial=0.0))
    sees = np.flatnonzero(sizes > HELD * largest)
    matrices = (
        problem.wave("stiffness", angle),
        problem.wave("damping", angle),
        problem.wave("mass", angle),
    )
    return Wave(sees, matrices, *_split(matrices[0], rows[sees]))


def _split(
    stiffness: ComplexArray, selection: ComplexArray
) -> tuple[ComplexArray, ComplexArray]:
    """Return T (static response to y = selection u) and N (motion with y = 0).

    Raises
    ------
    ValueError
        If the contacts see a wave in part only, or the sector is free while they stick.
    """
    dofs = len(stiffness)
    if len(selection) == 0:
        return np.zeros((dofs, 0), complex), np.eye(dofs, dtype=complex)
    if np.linalg.matrix_rank(selection, 1e-8) < len(selection):
        raise ValueError(
            "the contacts of a sector do not move independently in every wave around "
            "the disk: solve the whole disk"
        )
    free = scipy.linalg.null_space(selection)
    stuck = free.conj().T @ stiffness @ free
    rigidity = scipy.linalg.eigvalsh(stuck)
    if rigidity.size and rigidity[0] <= 1e-12 * rigidity[-1]:
        raise ValueError(
            "a sector can move freely while all contacts stick: hold it by a spring, a "
            "soft one perhaps"
        )
    direct = np.linalg.pinv(selection)
    static = direct - free @ np.linalg.solve(stuck, free.conj().T @ stiffness @ direct)
    return static, free
