"""Forces of what turns: skew-symmetric, across velocities; they do no work."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse.linalg import LinearOperator, aslinearoperator

from microslip_mechanics.arrays import Matrix
from microslip_mechanics.quantity import apart
from microslip_mechanics.structures.given_matrices import check_like, square_matrix
from microslip_mechanics.structures.structure import Structure


def turning(structure: Structure, given: ArrayLike | Matrix) -> Structure:
    """Return a structure M ü + (C + G) u̇ + K u = p.

    Parameters
    ----------
    structure
        That with M, C and K.
    given
        G [N s/m], skew-symmetric: an array, or sparse where the others are.

    Raises
    ------
    ValueError
        In one line, if G is not skew-symmetric or not of this structure.
    """
    matrix = square_matrix(given, "gyroscopic")
    check_like(matrix, structure.mass, "gyroscopic")
    _check_skew(matrix, structure.names)
    if abs(matrix).max() == 0.0:
        return structure
    damping = structure.damping
    if isinstance(damping, LinearOperator):
        matrix = aslinearoperator(matrix)
    return replace(structure, damping=damping + matrix, gyroscopic=True)


def _check_skew(matrix: Matrix, names: tuple[str, ...]) -> None:
    """Check that a matrix is skew-symmetric; the worst entry is named."""
    away = abs(matrix + matrix.T)
    if away.max() > 1e-9 * abs(matrix).max():
        row, column = np.unravel_index(int(away.argmax()), away.shape)
        there, back = apart(matrix[row, column], matrix[column, row])
        raise ValueError(
            f"gyroscopic is not skew-symmetric: {there} of {names[row]} by "
            f"{names[column]} but {back} of {names[column]} by {names[row]}: give the "
            "same with the other sign, and what damps as damping"
        )
