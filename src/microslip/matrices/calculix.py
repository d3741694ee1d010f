"""Text export of CalculiX: row, column, value; names in the ``.dof`` file beside it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.sparse

from microslip.matrices.entries import refuse_repeated
from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix, dof_name
from microslip.matrices.text_table import read_table, text_of


def read_calculix(path: Path) -> LabelledMatrix:
    """Read a ``.sti`` or ``.mas`` file (``*FREQUENCY, SOLVER=MATRIXSTORAGE``).

    Raises
    ------
    MatrixFileError
        If a line is not an entry, an entry is there twice, or the ``.dof`` file does
        not go with it.
    """
    table = read_table(path, "row, column, value")
    places = table.integers(slice(0, 2), 1, "index") - 1
    listed = path.with_suffix(".dof")
    names = _names(listed)
    if places.max() >= len(names):
        row = int(np.argmax(places.max(axis=1)))
        raise table.error(
            row,
            f"index {places.max() + 1} is more than the {len(names)} degrees of "
            f"freedom in {listed.name}: give the files of one job",
        )
    refuse_repeated(path, places, table.lines)
    matrix = scipy.sparse.coo_array(
        (table.values[:, 2], tuple(places.T)), shape=(len(names),) * 2
    )
    return LabelledMatrix(matrix, names)


def _names(path: Path) -> tuple[str, ...]:
    """Return the names in a file of lines such as ``12.3``, here ``12.z``."""
    names: list[str] = []
    for number, line in enumerate(text_of(path).splitlines(), start=1):
        node, point, direction = line.strip().partition(".")
        if not (node.isdecimal() and point and direction.isdecimal()):
            cause = f"{line.strip()!r} is not node.direction: give CalculiX's .dof file"
            raise MatrixFileError(path, cause, number)
        names.append(dof_name(int(node), int(direction)))
    return tuple(names)
