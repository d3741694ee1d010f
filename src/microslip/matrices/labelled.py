"""A sparse symmetric matrix over named degrees of freedom."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse

from microslip_mechanics.arrays import Matrix

DIRECTIONS = ("x", "y", "z", "rx", "ry", "rz")
"""degrees of freedom 1 to 6 of a node in Abaqus and CalculiX"""


@dataclass(frozen=True, slots=True)
class LabelledMatrix:
    """What a file holds; a matrix of which one half is given is completed."""

    matrix: Matrix
    """of scipy.sparse, shape (dofs, dofs)"""
    names: tuple[str, ...]
    """of the degrees of freedom; empty if the file has none"""

    def __post_init__(self) -> None:
        """Check the shape; complete a symmetric matrix.

        Raises
        ------
        ValueError
            If it is not square, holds a value that is not finite, has other names than
            rows, or a name twice.
        """
        if not np.isfinite(self.matrix.data).all():
            raise ValueError("a value is not finite: export the matrix again")
        rows, columns = self.matrix.shape
        if rows != columns:
            raise ValueError(
                f"the matrix has {rows} rows and {columns} columns: give a square one"
            )
        if self.names and len(self.names) != rows:
            raise ValueError(
                f"{len(self.names)} names, but {rows} rows: give one name for each row"
            )
        repeated = [name for name, often in Counter(self.names).items() if often > 1]
        if repeated:
            raise ValueError(f"{repeated[0]} is the name of several rows: name each")
        object.__setattr__(self, "matrix", _completed(self.matrix))

    def ordered(self, names: Sequence[str]) -> LabelledMatrix:
        """Return the matrix over other names in their order; rows not there are zero.

        Raises
        ------
        ValueError
            If a row's name is not among them.
        """
        place = {name: index for index, name in enumerate(names)}
        for name in self.names:
            if name not in place:
                raise ValueError(
                    f"degree of freedom {name} is not one of the stiffness: "
                    "export both matrices from the same model"
                )
        where = np.array([place[name] for name in self.names], dtype=int)
        entries = scipy.sparse.coo_array(self.matrix)
        rows, columns = entries.coords
        matrix = scipy.sparse.csc_array(
            (entries.data, (where[rows], where[columns])), shape=(len(names),) * 2
        )
        return LabelledMatrix(matrix, tuple(names))


def _completed(matrix: Matrix) -> Matrix:
    """Return a matrix as it is; with its other half where only one half is given.

    Of the given half some entries may stand above the diagonal and others below.
    """
    whole = scipy.sparse.csc_array(matrix, dtype=float)
    whole.sum_duplicates()
    apart = whole - scipy.sparse.diags_array(whole.diagonal())
    there = scipy.sparse.csc_array(apart, dtype=bool)
    if scipy.sparse.csc_array(there.multiply(there.T)).count_nonzero():
        return whole
    return scipy.sparse.csc_array(whole + apart.T)


def dof_name(node: int, direction: int) -> str:
    """Return the name of a node's degree of freedom, such as ``12.z``."""
    if 0 < direction <= len(DIRECTIONS):
        return f"{node}.{DIRECTIONS[direction - 1]}"
    return f"{node}.{direction}"
