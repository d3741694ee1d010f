"""Entries of a matrix, as a file lists them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.sparse
from numpy.typing import NDArray

from microslip.matrices.error import MatrixFileError
from microslip_mechanics.arrays import Array, Matrix


def assembled(
    path: Path, ends: NDArray[np.int64], values: Array, lines: NDArray[np.int64]
) -> tuple[Matrix, NDArray[np.int64]]:
    """Return the matrix of entries between labelled rows and columns, and the labels.

    Parameters
    ----------
    path
        The file.
    ends
        Labels of row and column of each entry, by turns, shape (2 entries, numbers).
    values, lines
        Of the entries, and of the file at which they stand, each of shape (entries,).

    Returns
    -------
    matrix
        Shape (dofs, dofs).
    labels
        Of its rows, ascending, shape (dofs, numbers).

    Raises
    ------
    MatrixFileError
        If an entry stands there twice.
    """
    labels, places = np.unique(ends, axis=0, return_inverse=True)
    places = places.reshape(-1, 2)
    refuse_repeated(path, places, lines)
    shape = (len(labels),) * 2
    return scipy.sparse.coo_array((values, tuple(places.T)), shape=shape), labels


def refuse_repeated(
    path: Path,
    places: NDArray[np.int64],
    lines: NDArray[np.int64],
    entry: str = "entry",
) -> None:
    """Check that no entry stands twice: to add them up would double a matrix.

    Those of both halves are different ones.

    Parameters
    ----------
    path
        The file.
    places
        Row and column of each entry, shape (entries, 2).
    lines
        Of the file at which they stand, from 1, shape (entries,).
    entry
        What one is called.

    Raises
    ------
    MatrixFileError
        That names the line of the first that does.
    """
    _, first = np.unique(places, axis=0, return_index=True)
    if len(first) < len(places):
        again = int(np.setdiff1d(np.arange(len(places)), first)[0])
        raise MatrixFileError(
            path,
            f"this {entry} stands in the file before: export the assembled matrix, "
            "not element by element, and once",
            int(lines[again]),
        )
