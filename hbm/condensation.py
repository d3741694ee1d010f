"""Exact dynamic condensation onto the relative motion of the contacts (theory §6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem


@dataclass(frozen=True, slots=True)
class CondensedStructure:
    """Dynamic stiffness seen by the relative coordinates y, and the way back to u.

    The motion is u = T y + N z, where z is what moves while all contacts stick; z is
    eliminated exactly at each frequency. Poles and residues of the stuck structure are
    computed once, so that a frequency costs two products of rank × poles.
    """

    stiffness: Array
    """TᵀKT [N/m], shape (rank, rank)"""
    damping: Array
    """TᵀCT"""
    mass: Array
    """TᵀMT"""
    poles: ComplexArray
    """λ of the stuck structure [rad/s], shape (poles,)"""
    viscous: ComplexArray
    """coupling z ← s y in modal form, shape (poles, rank)"""
    inertial: ComplexArray
    """coupling z ← s² y in modal form, shape (poles, rank)"""
    viscous_back: ComplexArray
    """coupling y ← z in modal form, shape (rank, poles)"""
    inertial_back: ComplexArray
    """shape (rank, poles)"""
    static: Array
    """T, shape (dofs, rank)"""
    modes: ComplexArray
    """motion per modal coordinate of z, shape (dofs, poles)"""
    participation: ComplexArray
    """modal coordinate per load, shape (poles, dofs)"""

    def dynamic_stiffness(
        self, variable: ComplexArray
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return S(s) and dS/ds.

        Parameters
        ----------
        variable
            Laplace variable s = ikω of each harmonic [rad/s], shape ``(orders,)``.

        Returns
        -------
        Shape ``(orders, rank, rank)`` (theory, eqs. 15–16).
        """
        s = variable[:, None, None]
        pole = (1.0 / (s[:, 0] - self.poles))[:, None, :]
        into = s * self.viscous + s**2 * self.inertial
        back = (s * self.viscous_back + s**2 * self.inertial_back) * pole
        slope = (self.viscous_back + 2.0 * s * self.inertial_back) * pole
        value = self.stiffness + s * self.damping + s**2 * self.mass - back @ into
        turn = slope @ into
        change = self.damping + 2.0 * s * self.mass
        return value, change - turn - turn.transpose(0, 2, 1) + (back * pole) @ into

    def load(
        self, variable: ComplexArray, force: ComplexArray
    ) -> tuple[ComplexArray, ComplexArray]:
        """Return the load that reaches y and its derivative by s.

        ``force`` [N] has shape ``(orders, dofs)``; the results ``(orders, rank)``.
        """
        s = variable[:, None]
        pole = 1.0 / (s - self.poles)
        modal = force @ self.participation.T
        direct = force @ self.static
        one, two = (
            modal * pole @ self.viscous_back.T,
            modal * pole @ self.inertial_back.T,
        )
        old_one = modal * pole**2 @ self.viscous_back.T
        old_two = modal * pole**2 @ self.inertial_back.T
        change = one + 2.0 * s * two - s * old_one - s**2 * old_two
        return direct - s * one - s**2 * two, -change

    def motion(
        self, variable: ComplexArray, relative: ComplexArray, force: ComplexArray
    ) -> ComplexArray:
        """Return u from y and the loads, shape ``(orders, dofs)``."""
        s = variable[:, None]
        into = s * (relative @ self.viscous.T) + s**2 * (relative @ self.inertial.T)
        modal = (force @ self.participation.T - into) / (s - self.poles)
        return relative @ self.static.T + modal @ self.modes.T


def condense(problem: Problem, selection: Array) -> CondensedStructure:
    """Return the structure condensed onto ``selection`` (shape (rank, dofs)).

    Raises
    ------
    ValueError
        If the structure can move freely while all contacts stick, or if its damping
        makes two of its poles coincide.
    """
    structure = problem.structure
    static, free = _split(structure.stiffness, selection)
    poles, shapes, forcing = _poles(
        *(free.T @ matrix @ free
          for matrix in (structure.mass, structure.damping, structure.stiffness))
    )  # fmt: skip
    viscous = free.T @ structure.damping @ static
    inertial = free.T @ structure.mass @ static
    return CondensedStructure(
        static.T @ structure.stiffness @ static,
        static.T @ structure.damping @ static,
        static.T @ structure.mass @ static,
        poles,
        forcing @ viscous,
        forcing @ inertial,
        viscous.T @ shapes,
        inertial.T @ shapes,
        static,
        free @ shapes,
        forcing @ free.T,
    )


def _split(stiffness: Array, selection: Array) -> tuple[Array, Array]:
    """Return T (static response to y) and N (motion with y = 0)."""
    free = np.ascontiguousarray(
        scipy.linalg.null_space(selection) if selection.size else np.eye(len(stiffness))
    )
    stuck = free.T @ stiffness @ free
    rigidity = scipy.linalg.eigvalsh(stuck)
    if rigidity.size and rigidity[0] <= 1e-12 * rigidity[-1]:
        raise ValueError(
            "the structure can move freely while all contacts stick: clamp it somewhere"
        )
    direct = np.linalg.pinv(selection)
    static = direct - free @ np.linalg.solve(stuck, free.T @ stiffness @ direct)
    return static, free


def _poles(
    mass: Array, damping: Array, stiffness: Array
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return λ, V, W with (s²M + sC + K)⁻¹ = V diag(1/(s − λ)) W."""
    squares, modes = scipy.linalg.eigh(stiffness, mass)
    frequencies = np.diag(np.sqrt(squares))
    count = len(squares)
    # The state (Ω q, q̇) makes a nearly skew matrix, whose eigenvectors are well apart.
    system = np.block(
        [
            [np.zeros((count, count)), frequencies],
            [-frequencies, -modes.T @ damping @ modes],
        ]
    )
    poles, vectors = (part.astype(complex) for part in np.linalg.eig(system))
    inverse = np.linalg.inv(vectors)
    error = np.abs(vectors @ (poles[:, None] * inverse) - system).max(initial=0.0)
    if error > 1e-8 * np.abs(system).max(initial=0.0):
        raise ValueError(
            "two poles of the structure coincide (a critically damped mode): "
            "change its damping slightly"
        )
    shapes = (modes / np.sqrt(squares)).astype(complex) @ vectors[:count]
    return poles, shapes, inverse[:, count:] @ modes.T.astype(complex)
