"""One matrix among the named variables of a file."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse

from microslip.matrices.error import MatrixFileError
from microslip_mechanics.arrays import Matrix


def matrix_of(path: Path, there: Mapping[str, Any], wanted: tuple[str, ...]) -> Matrix:
    """Return the first wanted variable as a sparse matrix of real numbers.

    Raises
    ------
    MatrixFileError
        If there is none, or it is not a matrix of real numbers.
    """
    name = chosen(path, list(there), wanted)
    value = there[name]
    if not scipy.sparse.issparse(value):
        value = np.asarray(value)
    if value.ndim != 2 or value.dtype.kind not in "fiu":
        raise MatrixFileError(
            path,
            f"{name} has {value.ndim} axes of {value.dtype}: "
            "give a matrix of real numbers",
        )
    return scipy.sparse.csc_array(value, dtype=float)


def chosen(path: Path, there: Sequence[str], wanted: tuple[str, ...]) -> str:
    """Return the first wanted name that is there.

    Raises
    ------
    MatrixFileError
        If there is none.
    """
    for name in wanted:
        if name in there:
            return name
    listed = ", ".join(there) or "nothing"
    raise MatrixFileError(
        path,
        f"holds no matrix {' or '.join(wanted)} but {listed}: write {path.name}:NAME",
    )
