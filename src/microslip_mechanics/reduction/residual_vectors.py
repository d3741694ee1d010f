"""Residual vectors: what modes miss of static responses (theory §6.1)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.projected_structure import symmetric
from microslip_mechanics.structures.stuck import StuckStructure
from microslip_mechanics.structures.stuck_modes import StuckModes

NEGLIGIBLE = 1e-8
"""share of a static response that counts as rounding"""


def residual_vectors(
    stuck: StuckStructure, modes: StuckModes, loads: Array
) -> tuple[Array, Array]:
    """Return what modes miss of the static response to loads, and its energy.

    Parameters
    ----------
    stuck, modes
        A structure that is held, and its slowest modes.
    loads
        Shape ``(free, loads)``.

    Returns
    -------
    vectors, energy
        Of unit mass, shape ``(free, some)``; twice the energy, ``(loads, loads)``.
    """
    left = stuck.factors.solve(loads)
    sizes = np.linalg.norm(stuck.factors.root(left), axis=0)
    sizes[sizes == 0.0] = 1.0
    for _ in range(2):  # once more, for what rounding leaves
        left = left - modes.shapes @ (modes.shapes.T @ (stuck.mass @ left))
    strain = stuck.factors.root(left)
    _, shares, mixing = np.linalg.svd(strain / sizes, full_matrices=False)
    kept = shares > NEGLIGIBLE
    vectors = left @ (mixing[kept].T / (sizes[:, None] * shares[kept]))
    squares, turned = np.linalg.eigh(symmetric(vectors.T @ (stuck.mass @ vectors)))
    return vectors @ (turned / np.sqrt(squares)), strain.T @ strain
