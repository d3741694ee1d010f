"""Text export of Abaqus: node, direction, node, direction, value on each line."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from microslip.matrices.entries import assembled
from microslip.matrices.labelled import LabelledMatrix, dof_name
from microslip.matrices.text_table import read_table


def read_abaqus(path: Path) -> LabelledMatrix:
    """Read what ``*MATRIX OUTPUT, FORMAT=MATRIX INPUT`` (or ``LABELS``) wrote.

    The lower half, the upper half or all of a symmetric matrix; degrees of freedom in
    ascending order of node and direction, those of internal nodes (negative) included.

    Raises
    ------
    MatrixFileError
        If a line is not an entry, or an entry is there twice.
    """
    table = read_table(path, "node, direction, node, direction, value", ",")
    nodes = table.values[:, 0:3:2]
    table.integers(slice(0, 3, 2), int(min(0.0, np.floor(nodes.min()))), "node")
    table.integers(slice(1, 4, 2), 1, "direction")
    ends = table.values[:, :4].astype(np.int64).reshape(-1, 2)
    matrix, labels = assembled(path, ends, table.values[:, 4], table.lines)
    names = tuple(dof_name(int(node), int(way)) for node, way in labels)
    return LabelledMatrix(matrix, names)
