"""Archives of numpy: dense matrices by name, or one sparse matrix of scipy."""

from __future__ import annotations

import zipfile
from collections.abc import Collection
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse

from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix
from microslip.matrices.variable import matrix_of

UNSOUND = ValueError, zipfile.BadZipFile, EOFError, OSError, NotImplementedError
"""what reading a damaged archive may raise"""

SPARSE = {"format", "shape", "data"}
"""arrays that :func:`scipy.sparse.save_npz` always writes"""


def read_npz(path: Path, wanted: tuple[str, ...]) -> LabelledMatrix:
    """Read the first array of ``wanted`` that is there; ``names`` are its rows' names.

    A file of :func:`scipy.sparse.save_npz` holds one matrix, without a name.

    Raises
    ------
    MatrixFileError
        If there is none, or the file is not such an archive.
    """
    _check_archive(path)
    there = _arrays(path, ("names", *SPARSE, *wanted))
    if there.keys() >= SPARSE:
        return LabelledMatrix(matrix_of(path, {"it": _sparse(path)}, ("it",)), ())
    names = tuple(str(name) for name in np.ravel(there.pop("names", ())))
    return LabelledMatrix(matrix_of(path, there, wanted), names)


def _check_archive(path: Path) -> None:
    try:
        with path.open("rb") as file:
            sound = zipfile.is_zipfile(file)
    except OSError as error:
        raise MatrixFileError.unreadable(path, error) from None
    if not sound:
        raise MatrixFileError(path, "is no sound archive: write it by numpy.savez")


def _sparse(path: Path) -> Any:  # noqa: ANN401  (of any of scipy's formats)
    try:
        return scipy.sparse.load_npz(path)
    except (*UNSOUND, KeyError) as error:
        raise MatrixFileError(
            path, f"is no sound archive of a sparse matrix ({error}): use save_npz"
        ) from None


def _arrays(path: Path, wanted: Collection[str]) -> dict[str, Any]:
    """Return the wanted arrays of an archive, and nothing of each other one."""
    try:
        with np.load(path, allow_pickle=False) as archive:
            return {
                name: archive[name] if name in wanted else None
                for name in archive.files
            }
    except UNSOUND as error:
        raise MatrixFileError(
            path, f"is no sound archive of numbers ({error}): use numpy.savez"
        ) from None
