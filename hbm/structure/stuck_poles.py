"""Poles of a structure whose contacts all stick (theory §6.1)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.structures.undamped_modes import undamped_modes


def stuck_poles(
    mass: Array, damping: Array, stiffness: Array
) -> tuple[ComplexArray, ComplexArray, ComplexArray]:
    """Return λ, V, W with (s²M + sC + K)⁻¹ = V diag(1/(s − λ)) W.

    Shapes (poles,), (dofs, poles) and (poles, dofs), with twice as many poles as dofs;
    λ is in rad/s.

    Raises
    ------
    ValueError
        If two poles coincide.
    """
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
