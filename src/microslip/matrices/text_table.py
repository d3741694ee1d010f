"""Columns of numbers in a text file, with the number of the line of each row."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from microslip.matrices.error import MatrixFileError
from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class TextTable:
    """Numbers of a text file, row by row."""

    path: Path
    values: Array
    """shape (rows, columns)"""
    lines: NDArray[np.int64]
    """in the file, from 1, shape (rows,)"""

    def integers(self, columns: slice, smallest: int, what: str) -> NDArray[np.int64]:
        """Return columns of whole numbers from ``smallest`` on.

        Raises
        ------
        MatrixFileError
            If one is not whole or too small; ``what`` says what they are.
        """
        values = self.values[:, columns]
        bad = (values != np.floor(values)) | (values < smallest)
        if bad.any():
            row, column = np.argwhere(bad)[0]
            raise self.error(
                int(row),
                f"{what} {values[row, column]:g} is not a whole number from "
                f"{smallest} on: export the matrix again",
            )
        return values.astype(np.int64)

    def error(self, row: int, cause: str) -> MatrixFileError:
        """Return the error that names the line of a row."""
        return MatrixFileError(self.path, cause, int(self.lines[row]))


def read_table(path: Path, columns: str, separator: str | None = None) -> TextTable:
    """Read a table; lines that begin with ``*``, ``#`` or ``%`` are comments.

    Parameters
    ----------
    path
        A text file.
    columns
        Their names, separated by commas: what an error says is expected.
    separator
        Between numbers; blanks if left out.

    Raises
    ------
    MatrixFileError
        If the file is not there, is empty, or a line holds something else.
    """
    count = columns.count(",") + 1
    rows, lines = [], []
    for number, line in enumerate(text_of(path).splitlines(), start=1):
        if not line.strip() or line.lstrip()[0] in "*#%":
            continue
        words = line.rstrip(" ,").split(separator)
        try:
            row = [float(word.replace("D", "E").replace("d", "e")) for word in words]
        except ValueError:
            row = []
        if len(row) != count or not np.isfinite(row).all():
            cause = (
                f"{line.strip()!r} is not {columns}: export the matrix again as text"
            )
            raise MatrixFileError(path, cause, number)
        rows.append(row)
        lines.append(number)
    if not rows:
        raise MatrixFileError(path, f"no entries: each line must give {columns}")
    return TextTable(path, np.array(rows), np.array(lines))


def text_of(path: Path) -> str:
    """Return the text of a file, in UTF-8 or, as comments may be, in Latin-1.

    Raises
    ------
    MatrixFileError
        If it is not there or is not text.
    """
    try:
        content = path.read_bytes()
    except OSError as error:
        raise MatrixFileError.unreadable(path, error) from None
    if b"\0" in content:
        raise MatrixFileError(path, "is not text: give the text export of the matrix")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("latin-1")
