"""What moves of a structure while all of its contacts stick, and its poles."""

from __future__ import annotations

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.undamped_modes import undamped_modes


def split(stiffness: Array, selection: Array) -> tuple[Array, Array]:
    """Return T (static response to y = selection u) and N (motion with y = 0).

    Raises
    ------
    ValueError
        If the structure can move freely while all contacts stick.
    """
    free = np.ascontiguousarray(
        scipy.linalg.null_space(selection) if selection.size else np.eye(len(stiffness))
    )
    stuck = free.T @ stiffness @ free
    rigidity, _ = undamped_modes(stuck)
    if (rigidity <= 0.0).any():
        raise ValueError(
            "the structure can move freely while all contacts stick: clamp it somewhere"
        )
    direct = np.linalg.pinv(selection)
    static = direct - free @ np.linalg.solve(stuck, free.T @ stiffness @ direct)
    return static, free


def stuck_poles(
    mass: Array, damping: Array, stiffness: Array
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return λ, V, W with (s²M + sC + K)⁻¹ = V diag(1/(s − λ)) W."""
    squares, modes = undamped_modes(stiffness, mass)
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
