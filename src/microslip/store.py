"""Results to files, netCDF ones back as well; docs/files.md describes the schema."""

from __future__ import annotations

import contextlib
import csv
import dataclasses
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.io import netcdf_file

from microslip.record_file import Value
from microslip.schema import (
    CURVE,
    GROWS,
    SCHEMAS,
    Growing,
    Result,
    attributes,
    checkpoint_of,
    columns,
    kind_of,
)
from microslip.stream import ORIGIN, RESERVED, Head, Stream, rows_of
from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.response import ResponseCurve
from microslip_mechanics.thinning import thinned
from microslip_mechanics.time_history import TimeHistory, joined

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.figure import Figure

TEXTS = ("kind", "scene", "command")
CHUNK = 50_000
"""rows that are read at a time"""


class StoreError(MicroslipError):
    """A file that cannot be written or read as a result."""


@dataclass(frozen=True, slots=True)
class Stored:
    """A result with the text of the scene and the command that made it."""

    result: Result
    scene: str
    command: str


def save(path: Path, stored: Stored) -> None:
    """Write a result as netCDF 3 (classic, 64-bit offsets).

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    result = stored.result
    if not isinstance(result, ResponseCurve):
        stream = begin(path, result, scene=stored.scene, command=stored.command)
        with told(path):
            stream.append(result)
            stream.end(result.ending)
            stream.close()
        return
    _, schema = kind_of(result)
    about = _about(result, scene=stored.scene, command=stored.command)
    with told(path), netcdf_file(path, "w", version=2) as file:
        for name, value in about.items():
            setattr(file, name, value)
        for name, values in columns(result, schema).items():
            dimensions, unit, meaning = schema[name]
            _dimensions(file, dimensions, values.shape)
            variable = file.createVariable(name, values.dtype, dimensions)
            variable[:] = values
            setattr(variable, "long_name", meaning)  # noqa: B010  (an attribute of the file)
            setattr(variable, "units", unit)  # noqa: B010


def begin(path: Path, block: Growing, *, scene: str, command: str) -> Stream:
    """Begin a file for a march with this first block, which is still to be written.

    Until the stream's end is told, the file says that the march was interrupted.

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    about = _about(block, scene=scene, command=command)
    ending = block.ending.encode() if len(block.ending) > RESERVED else b"interrupted"
    about |= {"iterations": 0, "divided": 0, "ending": ending}
    with told(path):
        return Stream(path, Head.of(block, about))


@contextlib.contextmanager
def told(path: Path) -> Iterator[None]:
    """Make one line of what the system says of a file that cannot be written."""
    try:
        yield
    except OSError as error:
        reason = error.strerror or error
        raise StoreError(f"{path} cannot be written: {reason}") from None


def save_figure(path: Path, figure: Figure) -> None:
    """Write a picture in the format of its ending.

    Raises
    ------
    StoreError
        If the file cannot be written or the ending is unknown.
    """
    try:
        figure.savefig(path, dpi=160)
    except OSError as error:
        reason = error.strerror or error
        raise StoreError(f"{path} cannot be written: {reason}") from None
    except ValueError:
        raise StoreError(
            f"{path} cannot be written: give an ending such as .png, .pdf or .svg"
        ) from None


def save_table(
    path: Path, names: Iterable[str], rows: Iterable[Iterable[object]]
) -> None:
    """Write a table with a line of names as CSV.

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    try:
        with path.open("w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([names, *rows])
    except OSError as error:
        reason = error.strerror or error
        raise StoreError(f"{path} cannot be written: {reason}") from None


def load(path: Path, most: int | None = None) -> Stored:
    """Read a result.

    A time history of more than ``most`` rows comes thinned: of each stretch of rows the
    extremes, and the energies at its end.

    Raises
    ------
    StoreError
        If there is no such file, or it is not a result.
    """
    with _told(path), netcdf_file(path, "r", mmap=True) as file:
        texts = {name: getattr(file, name).decode() for name in TEXTS}
        kind = _known(path, texts["kind"])
        head = Head.read(file, kind) if kind in GROWS else None
        if head is None:
            return Stored(_curve(file), texts["scene"], texts["command"])
    with _told(path):
        return Stored(_grown(path, head, most), texts["scene"], texts["command"])


def end_of(path: Path) -> tuple[Growing, Head]:
    """Return the end of a march, without rows, and the head of its file.

    Raises
    ------
    StoreError
        If there is no such file, or its march cannot go on.
    """
    with _told(path), netcdf_file(path, "r", mmap=True) as file:
        kind = _known(path, getattr(file, TEXTS[0]).decode())
        if kind not in GROWS:
            raise StoreError(f"{path} holds a {kind}: give what sweep or dwell wrote")
        head = Head.read(file, kind)
    if "checkpoint" not in head.fixed:
        raise StoreError(f"{path} does not know where its march can go on: march anew")
    # a march that was killed may have written half of a block behind it
    head = dataclasses.replace(head, rows=int(head.fixed["checkpoint"][0]))
    with _told(path):
        end = _result(head, rows_of(path, head, 0, 0))
        return end, head


@contextlib.contextmanager
def _told(path: Path) -> Iterator[None]:
    """Make one line of what is wrong with a file that is read."""
    try:
        yield
    except FileNotFoundError:
        raise StoreError(f"there is no result file {path}") from None
    except OSError as error:
        raise StoreError(f"{path} cannot be read: {error.strerror or error}") from None
    except (TypeError, ValueError, KeyError, AttributeError, IndexError):
        raise StoreError(
            f"{path} is not a result file: give what frc or sweep wrote"
        ) from None


def _known(path: Path, kind: str) -> str:
    if kind not in SCHEMAS:
        raise StoreError(f"{path} holds a {kind!r}, which this version does not know")
    return kind


def _about(result: Result, *, scene: str, command: str) -> dict[str, Value]:
    """Return the global attributes of a file, ``ORIGIN`` first."""
    source = f"microslip {version('microslip')}"
    texts = zip(ORIGIN, (kind_of(result)[0], source, command, scene), strict=True)
    return {
        name: value.encode() if isinstance(value, str) else value
        for name, value in (*texts, *attributes(result).items())
    }


def _dimensions(
    file: netcdf_file, names: tuple[str, ...], shape: tuple[int, ...]
) -> None:
    for name, size in zip(names, shape, strict=True):
        if name not in file.dimensions:
            file.createDimension(name, size)


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
        return _names(values)
    return checkpoint_of(values.astype(float))


def _curve(file: netcdf_file) -> ResponseCurve:
    made: dict[str, Any] = {}
    for field in dataclasses.fields(ResponseCurve):
        if field.name in CURVE:
            dimensions, *_ = CURVE[field.name]
            made[field.name] = _variable(file, field.name, dimensions)
        else:
            value = getattr(file, field.name)
            made[field.name] = (
                value.decode() if isinstance(value, bytes) else value.item()
            )
    return ResponseCurve(**made)


def _variable(file: netcdf_file, name: str, dimensions: tuple[str, ...]) -> object:
    """Return names as a tuple of texts, numbers as float64 in native order.

    What the file leaves out is empty, if one of its dimensions is.
    """
    sizes = [file.dimensions.get(each) or 0 for each in dimensions]
    if name not in file.variables and 0 in sizes:
        return () if "name" in dimensions else np.zeros(sizes)
    data = file.variables[name].data
    return _names(data) if data.dtype.kind == "S" else data.astype(float)


def _names(data: np.ndarray) -> tuple[str, ...]:
    rows = np.ascontiguousarray(data).view(f"S{data.shape[-1]}")
    return tuple(text.decode() for text in rows.ravel())
