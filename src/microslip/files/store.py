"""Results to files; docs/files.md describes the schema."""

from __future__ import annotations

import contextlib
import csv
import io
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

from scipy.io import netcdf_file

from microslip.errors import GivenError
from microslip.files.record_layout import Value
from microslip.files.schema import (
    CURVE,
    Growing,
    Result,
    attributes,
    columns,
    kind_of,
)
from microslip.files.stream import ORIGIN, RESERVED, Head, Stream
from microslip.files.whole_file import write_whole
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.results.response_curve import ResponseCurve

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.figure import Figure


class StoreError(MicroslipError):
    """A file that cannot be written or read as a result."""


class WrongFileError(StoreError, GivenError):
    """A file that a user has given and that is not what it should be."""


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
    made = _curve_file(result, scene=stored.scene, command=stored.command)
    with told(path):
        write_whole(path, made)


def _curve_file(curve: ResponseCurve, *, scene: str, command: str) -> bytes:
    """Return what a curve's file holds: an interruption leaves no half of it."""
    _, schema = kind_of(curve)
    made = io.BytesIO()
    with netcdf_file(made, "w", version=2) as file:
        for name, value in _about(curve, scene=scene, command=command).items():
            setattr(file, name, value)
        for name, values in columns(curve, schema).items():
            dimensions, unit, meaning = schema[name]
            unit = _unit(curve, name, unit)
            _dimensions(file, dimensions, values.shape)
            variable = file.createVariable(name, values.dtype, dimensions)
            variable[:] = values
            setattr(variable, "long_name", meaning)  # noqa: B010  (an attribute of the file)
            setattr(variable, "units", unit.encode())  # noqa: B010
        file.flush()
        return made.getvalue()


def _unit(curve: ResponseCurve, name: str, unit: str) -> str:
    """Return the unit of a column.

    That of a parameter stands behind its name; along frequency it is that of this.
    """
    if name.startswith("parameter") and not curve.along:
        return CURVE["frequency"][1]
    _, bracket, found = curve.along.rpartition(" [")
    known = name.startswith("parameter") and bracket and found.endswith("]")
    return found.removesuffix("]") if known else unit


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
    ending = path.suffix[1:].lower()
    if ending not in figure.canvas.get_supported_filetypes():
        raise WrongFileError(
            f"{path} cannot be written: give an ending such as .png, .pdf or .svg"
        )
    drawn = io.BytesIO()  # an interruption leaves no half a picture
    figure.savefig(drawn, format=ending, dpi=160)
    with told(path):
        write_whole(path, drawn.getvalue())


def save_table(
    path: Path, names: Iterable[str], rows: Iterable[Iterable[object]]
) -> None:
    """Write a table with a line of names as CSV.

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    made = io.StringIO(newline="")
    csv.writer(made).writerows([names, *rows])
    with told(path):
        write_whole(path, made.getvalue().encode())


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
