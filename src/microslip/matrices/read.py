"""A structure from files of matrices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse

from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix
from microslip.matrices.source import MatrixSource
from microslip_mechanics.arrays import Matrix
from microslip_mechanics.structures.structure import Structure

USUAL = {
    "mass": ("M", "mass", "MASS", "MAAX"),
    "damping": ("C", "D", "damping", "DAMPING", "BAAX"),
    "stiffness": ("K", "stiffness", "STIFFNESS", "KAAX"),
}
"""names of variables that are looked for if none is given"""
HELD = 1e30
"""stiffness of a degree of freedom from which on it counts as held [N/m]

Exports may keep a boundary condition as a diagonal element of, say, 1e36."""


@dataclass(frozen=True, slots=True)
class MatrixFiles:
    """Files of the three matrices of a structure."""

    stiffness: MatrixSource
    """its file gives the names and their order; ``1``, ``2``, … if it has none"""
    mass: MatrixSource
    damping: MatrixSource | None = None
    """none if left out: zero"""


def read_structure(files: MatrixFiles) -> Structure:
    """Return the structure that the files hold, sparse.

    Degrees of freedom that a huge stiffness marks as held are left out.

    Raises
    ------
    MatrixFileError
        If a file is malformed or does not go with the others.
    """
    stiffness = files.stiffness.read(USUAL["stiffness"])
    count = stiffness.matrix.shape[0]
    names = stiffness.names or tuple(str(row + 1) for row in range(count))
    mass = _beside(files.mass, "mass", stiffness, names)
    damping = scipy.sparse.csc_array(stiffness.matrix.shape)
    if files.damping is not None:
        damping = _beside(files.damping, "damping", stiffness, names)
    free = np.flatnonzero(stiffness.matrix.diagonal() < HELD)
    if not free.size:
        raise MatrixFileError(
            files.stiffness.path,
            f"all degrees of freedom are held, by {HELD:g} N/m or more on the "
            "diagonal: give the stiffness of what moves",
        )
    mass, damping, spring = (
        scipy.sparse.csc_array(each[free][:, free])
        for each in (mass, damping, stiffness.matrix)
    )
    try:
        return Structure(mass, damping, spring, tuple(names[dof] for dof in free))
    except ValueError as error:
        role = str(error).split()[0]  # it begins with the matrix that is wrong
        wrong = {"mass": files.mass, "damping": files.damping}.get(role)
        path = (wrong or files.stiffness).path
        raise MatrixFileError(path, str(error)) from None


def _beside(
    source: MatrixSource, role: str, stiffness: LabelledMatrix, names: tuple[str, ...]
) -> Matrix:
    """Return mass or damping over the degrees of freedom of the stiffness."""
    found = source.read(USUAL[role])
    if found.names and stiffness.names:
        try:
            return found.ordered(stiffness.names).matrix
        except ValueError as error:
            raise MatrixFileError(source.path, str(error)) from None
    if found.matrix.shape != stiffness.matrix.shape:
        raise MatrixFileError(
            source.path,
            f"{role} has {found.matrix.shape[0]} rows, but the stiffness "
            f"{len(names)}: give matrices of the same model",
        )
    return found.matrix
