"""Nastran's direct matrix input, as programs punch it: DMIG entries in large fields."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from microslip.matrices.entries import assembled
from microslip.matrices.error import MatrixFileError
from microslip.matrices.labelled import LabelledMatrix, dof_name
from microslip.matrices.text_table import text_of
from microslip.matrices.variable import chosen

SYMMETRIC, REAL = (1, 6), (1, 2)
"""values of IFO for square and symmetric matrices, of TIN for real ones"""
Entry = tuple[int, tuple[int, int], tuple[int, int], float]
"""line, node and direction of row and column, value"""


def read_nastran(path: Path, wanted: tuple[str, ...]) -> LabelledMatrix:
    """Read the first matrix of ``wanted`` that is there, from a ``.pch`` file.

    Scalar points, whose direction is 0, are named by their number alone.

    Raises
    ------
    MatrixFileError
        If there is none, it is not real and square, a line is malformed, or an entry
        is there twice.
    """
    lines = text_of(path).splitlines()
    name = chosen(path, _headers(path, lines), wanted)
    entries = list(_entries(path, lines, name))
    if not entries:
        raise MatrixFileError(
            path, f"{name} has no entries in large fields (DMIG*): punch it again"
        )
    ends = np.array([[row, column] for _, row, column, _ in entries])
    values = np.array([value for *_, value in entries])
    numbers = np.array([line for line, *_ in entries])
    matrix, labels = assembled(path, ends.reshape(-1, 2), values, numbers)
    names = (
        dof_name(int(node), int(way)) if way else str(node) for node, way in labels
    )
    return LabelledMatrix(matrix, tuple(names))


def _headers(path: Path, lines: list[str]) -> list[str]:
    """Return the names of the matrices; check that each is real and square."""
    found: list[str] = []
    other: list[str] = []
    for number, line in enumerate(lines, start=1):
        words = line.split()
        if not re.match(r"DMIG\s+\S+\s+0\s", line):
            continue
        if len(words) < 5 or not (words[3] + words[4]).isdecimal():
            raise MatrixFileError(
                path, "a DMIG header without form and type: punch it again", number
            )
        usable = int(words[3]) in SYMMETRIC and int(words[4]) in REAL
        (found if usable else other).append(words[1])
    if not found and not other:
        raise MatrixFileError(
            path, "has no DMIG header in fields of 8 characters: punch the matrix"
        )
    if other and not found:
        raise MatrixFileError(
            path, f"{other[0]} is complex or not square: give a real square matrix"
        )
    return found


def _entries(path: Path, lines: list[str], name: str) -> Iterator[Entry]:
    """Yield the entries of one matrix; comments and empty lines may stand anywhere."""
    column = None
    for number, line in enumerate(lines, start=1):
        if line.startswith("$") or not line.strip():
            continue
        key, fields = line[:8].strip(), _fields(line)
        if key == "DMIG*":
            column = None
            if fields[0] == name:
                column = _dof(path, number, fields[1], fields[2])
        elif key.startswith("*") and column is not None:
            row = _dof(path, number, fields[0], fields[1])
            yield number, row, column, _value(path, number, fields[2])
        else:
            column = None


def _fields(line: str) -> list[str]:
    """Return the four fields of 16 characters after the first one of 8."""
    return [line[start : start + 16].strip() for start in range(8, 72, 16)]


def _dof(path: Path, number: int, node: str, direction: str) -> tuple[int, int]:
    """Return node and direction."""
    direction = direction or "0"
    if not (node.isdecimal() and direction in tuple("0123456")):
        raise MatrixFileError(
            path,
            f"{node!r}, {direction!r} are no node and direction from 0 to 6: "
            "punch the matrix again",
            number,
        )
    return int(node), int(direction)


def _value(path: Path, number: int, text: str) -> float:
    """Return a number, which Nastran may write as ``1.5D+06`` or ``1.5+6``."""
    plain = re.sub(r"(?<=[\d.])([+-]\d+)$", r"E\1", text.upper().replace("D", "E"))
    try:
        value = float(plain)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise MatrixFileError(
            path, f"{text!r} is no number: punch the matrix again", number
        )
    return value
