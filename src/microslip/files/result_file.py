"""Results back from netCDF files; docs/files.md describes the schema."""

from __future__ import annotations

import contextlib
import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import netcdf_file

from microslip.files.schema import GROWS, SCHEMAS, Growing, checkpoint_of, names_of
from microslip.files.store import Stored, WrongFileError
from microslip.files.stored_curve import stored_curve
from microslip.files.stream import Head, rows_of
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.thinning import thinned
from microslip_mechanics.results.time_history import TimeHistory

TEXTS = ("kind", "scene", "command")
REMEDY = "give what frc, follow, sweep, dwell or decay wrote"
CHUNK = 50_000
"""rows that are read at a time"""
SHARED = 6
"""rows that a stretch has of the one before: even, and what lies between two rows, of
every second one too, is told with their neighbours"""


def load(path: Path, most: int | None = None) -> Stored:
    """Read a result.

    A time history of more than ``most`` rows comes thinned: of each stretch of rows the
    extremes, and the energies at its end.

    Raises
    ------
    WrongFileError
        If there is no such file, or it is not a result.
    """
    with _opened(path) as file:
        texts = {name: getattr(file, name).decode() for name in TEXTS}
        kind = _known(path, texts["kind"])
        head = Head.read(file, kind) if kind in GROWS else None
        if head is None:
            return Stored(stored_curve(file), texts["scene"], texts["command"])
    with _told(path):
        return Stored(_grown(path, head, most), texts["scene"], texts["command"])


def stretches(path: Path) -> Iterator[Growing]:
    """Yield all rows of what has grown, stretch by stretch.

    Raises
    ------
    WrongFileError
        If there is no such file, or it is not a result.
    """
    with _opened(path) as file:
        head = Head.read(file, _known(path, getattr(file, TEXTS[0]).decode()))
    for first in range(0, max(head.rows - SHARED, 1), CHUNK):
        count = min(CHUNK + SHARED, head.rows - first)
        with _told(path):
            part = _result(head, rows_of(path, head, first, count))
        yield part


def end_of(path: Path) -> tuple[Growing, Head]:
    """Return the end of a march, without rows, and the head of its file.

    Raises
    ------
    WrongFileError
        If there is no such file, or its march cannot go on.
    """
    with _opened(path) as file:
        kind = _known(path, getattr(file, TEXTS[0]).decode())
        if kind not in GROWS:
            raise WrongFileError(
                f"{path} holds a {kind}: give what sweep or dwell wrote"
            )
        head = Head.read(file, kind)
    if "checkpoint" not in head.fixed:
        raise WrongFileError(
            f"{path} does not know where its march can go on: march anew"
        )
    # a march that was killed may have written half of a block behind it
    head = dataclasses.replace(head, rows=int(head.fixed["checkpoint"][0]))
    with _told(path):
        end = _result(head, rows_of(path, head, 0, 0))
        return end, head


@contextlib.contextmanager
def _opened(path: Path) -> Iterator[netcdf_file]:
    """Open a file to read; a damaged one, which scipy leaves open, is closed too."""
    with (
        _told(path),
        path.open("rb") as stream,
        netcdf_file(stream, "r", mmap=True) as file,
    ):
        yield file


@contextlib.contextmanager
def _told(path: Path) -> Iterator[None]:
    """Make one line of what is wrong with a file that is read."""
    try:
        yield
    except FileNotFoundError:
        raise WrongFileError(f"there is no result file {path}: {REMEDY}") from None
    except OSError as error:
        raise WrongFileError(
            f"{path} cannot be read: {error.strerror or error}"
        ) from None
    except KeyError as error:
        lacks = f"it has no {error.args[0]}" if error.args else "something is missing"
        raise WrongFileError(
            f"{path} is not a result file, {lacks}: {REMEDY}"
        ) from None
    except (TypeError, ValueError, AttributeError, IndexError):
        raise WrongFileError(f"{path} is not a result file: {REMEDY}") from None


def _known(path: Path, kind: str) -> str:
    if kind not in SCHEMAS:
        raise WrongFileError(
            f"{path} holds a {kind!r}, which this version does not know: {REMEDY}"
        )
    return kind


def _grown(path: Path, head: Head, most: int | None) -> Growing:
    """Return what a file has grown to, thinned if it is longer than ``most``."""
    if most is None or head.rows <= most or head.kind != "time history":
        return _result(head, rows_of(path, head, 0, head.rows))
    stride = -(-2 * head.rows // most)
    parts = []
    chunk = stride * max(1, CHUNK // stride)
    for first in range(0, head.rows, chunk):
        rows = rows_of(path, head, first, min(chunk, head.rows - first))
        part = _result(head, rows)
        if isinstance(part, TimeHistory):
            parts.append(thinned(part, stride))
    whole = joined(parts, parts[0].ending)
    return dataclasses.replace(
        whole, iterations=parts[0].iterations, divided=parts[0].divided
    )


def _result(head: Head, rows: dict[str, Array]) -> Growing:
    """Return a result of some rows; variables without content are empty."""
    made: dict[str, Any] = {}
    made_of, schema = SCHEMAS[head.kind]
    count = len(rows["time"])
    for field in dataclasses.fields(made_of):
        if field.name in head.growing:
            made[field.name] = rows[field.name]
        elif field.name in head.fixed:
            made[field.name] = _fixed(head.fixed[field.name])
        elif field.name in head.about:
            value = head.about[field.name]
            made[field.name] = value.decode() if isinstance(value, bytes) else value
        elif field.default is field.default_factory is dataclasses.MISSING:
            names = schema[field.name][0]
            if head.sizes.keys() >= set(names):
                raise KeyError(field.name)
            made[field.name] = () if "name" in names else np.zeros((count, 0))
    return made_of(**made)  # type: ignore[return-value]


def _fixed(values: np.ndarray) -> object:
    """Return names or a checkpoint."""
    if values.dtype.kind == "S":
        return names_of(values)
    return checkpoint_of(values.astype(float))
