"""Entries that stand in a file twice: to add them up would double a matrix."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from microslip.matrices.error import MatrixFileError


def refuse_repeated(
    path: Path,
    places: NDArray[np.int64],
    lines: NDArray[np.int64],
    entry: str = "entry",
) -> None:
    """Check that no entry stands twice; those of both halves are different ones.

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
