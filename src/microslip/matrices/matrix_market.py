"""Matrix Market files."""

from __future__ import annotations

import re
from pathlib import Path

import scipy.io
import scipy.sparse

from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix


def read_matrix_market(path: Path) -> LabelledMatrix:
    """Read a real matrix, coordinate or array, general or symmetric.

    Raises
    ------
    MatrixFileError
        If the file is malformed, or not real.
    """
    try:
        *_, field, symmetry = scipy.io.mminfo(path)
    except (ValueError, OSError) as error:
        raise _malformed(path, error) from None
    if field not in ("real", "integer", "double") or symmetry == "skew-symmetric":
        raise MatrixFileError(
            path, f"is {field} and {symmetry}: give a real symmetric matrix", 1
        )
    try:
        matrix = scipy.io.mmread(path)
    except (ValueError, OverflowError, OSError) as error:
        raise _malformed(path, error) from None
    return LabelledMatrix(scipy.sparse.csc_array(matrix), ())


def _malformed(path: Path, error: Exception) -> MatrixFileError:
    """Return the error in one line; scipy's reader begins with the line's number."""
    text = " ".join(str(error).split())
    found = re.match(r"Line (\d+): (.*)", text)
    line, cause = (int(found[1]), found[2]) if found else (None, text)
    return MatrixFileError(
        path, f"{cause.rstrip('.')}: write the Matrix Market file again", line
    )
