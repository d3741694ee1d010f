"""Matrix Market files."""

from __future__ import annotations

import io
import re
from pathlib import Path

import scipy.io
import scipy.sparse

from microslip.errors import one_line
from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix
from microslip.matrices.sparse_kind import either_kind
from microslip.matrices.text_table import text_of

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
        If the file is malformed, or not real.
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
    _check_entries(path, text, *ENTRIES[layout])
    try:
        with either_kind():
            matrix = scipy.io.mmread(io.BytesIO(text.encode()))
    except (ValueError, OverflowError, OSError) as error:
        raise _malformed(path, error) from None
    return LabelledMatrix(scipy.sparse.csc_array(matrix), ())


def _check_entries(
    path: Path, text: str, expected: str, pattern: re.Pattern[str]
) -> None:
    """Raise an error that names the first line of which something would be left out."""
    sizes = True
    for number, line in enumerate(text.splitlines(), start=1):
        words = line.strip()
        if not words or words.startswith("%"):
            continue
        if not sizes and not pattern.fullmatch(words):
            cause = f"{words!r} is not {expected}: write the Matrix Market file again"
            raise MatrixFileError(path, cause, number)
        sizes = False


def _malformed(path: Path, error: Exception) -> MatrixFileError:
    """Return the error in one line; scipy's reader begins with the line's number."""
    text = one_line(error)
    found = re.match(r"Line (\d+): (.*)", text)
    line, cause = (int(found[1]), found[2]) if found else (None, text)
    return MatrixFileError(
        path, f"{cause.rstrip('.')}: write the Matrix Market file again", line
    )
