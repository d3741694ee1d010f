"""Matrix Market files."""

from __future__ import annotations

import io
import re
from pathlib import Path

import numpy as np
import scipy.io
import scipy.sparse

from microslip.errors import one_line
from microslip.matrices.entries import refuse_repeated
from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix
from microslip.matrices.sparse_kind import either_kind
from microslip.matrices.text_table import text_of
from microslip_mechanics.arrays import Matrix

BANNER = "%%MatrixMarket"
"""with which they begin, in any case"""
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
ENTRIES = {
    "coordinate": ("row, column, value", re.compile(rf"\d+\s+\d+\s+{NUMBER}")),
    "array": ("a value", re.compile(NUMBER)),
}
"""what a line after that of the sizes holds: in words, and its pattern"""


def read_matrix_market(path: Path) -> LabelledMatrix:
    """Read a real matrix, coordinate or array, general or symmetric.

    Raises
    ------
    MatrixFileError
        If the file is malformed or not real, or an entry is there twice: once in each
        half where the file says that it is symmetric.
    """
    # Fortran writes 1.5D+06, of which scipy's reader takes 1.5 without a word
    text = re.sub(r"(?<=[\d.])[dD](?=[-+]?\d)", "E", text_of(path))
    text = BANNER + text[len(BANNER) :]
    try:
        *_, layout, field, symmetry = scipy.io.mminfo(io.BytesIO(text.encode()))
    except (ValueError, OSError) as error:
        raise _malformed(path, error) from None
    if field not in ("real", "integer", "double") or symmetry == "skew-symmetric":
        raise MatrixFileError(
            path, f"is {field} and {symmetry}: give a real symmetric matrix", 1
        )
    lines = _entries(path, text, *ENTRIES[layout])
    try:
        with either_kind():
            matrix: Matrix = scipy.io.mmread(io.BytesIO(text.encode()))
    except (ValueError, OverflowError, OSError) as error:
        raise _malformed(path, error) from None
    whole = scipy.sparse.csc_array(matrix)
    if layout == "coordinate" and whole.nnz < matrix.nnz:
        _refuse_repeated(path, lines, symmetry)
    return LabelledMatrix(whole, ())


def _entries(
    path: Path, text: str, expected: str, pattern: re.Pattern[str]
) -> dict[int, str]:
    """Return the entries by the number of their line.

    Raise an error that names the first of which something would be left out.
    """
    sizes, found = True, {}
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.strip()
        if not words or words.startswith("%"):
            continue
        if not sizes and not pattern.fullmatch(words):
            cause = f"{words!r} is not {expected}: write the Matrix Market file again"
            raise MatrixFileError(path, cause, number)
        if not sizes:
            found[number] = words
        sizes = False
    return found


def _refuse_repeated(path: Path, lines: dict[int, str], symmetry: str) -> None:
    """Refuse an entry that stands twice, which scipy's reader has added up."""
    places = np.array([words.split()[:2] for words in lines.values()]).astype(np.int64)
    entry = "entry"
    if symmetry == "symmetric":
        places, entry = np.sort(places, axis=1), "entry or its mirror image"
    refuse_repeated(path, places, np.array(list(lines)), entry)


def _malformed(path: Path, error: Exception) -> MatrixFileError:
    """Return the error in one line; scipy's reader begins with the line's number."""
    text = one_line(error)
    found = re.match(r"Line (\d+): (.*)", text)
    line, cause = (int(found[1]), found[2]) if found else (None, text)
    return MatrixFileError(
        path, f"{cause.rstrip('.')}: write the Matrix Market file again", line
    )
