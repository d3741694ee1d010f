"""Results to files, netCDF ones back as well; docs/files.md describes the schema."""

from __future__ import annotations

import csv
import dataclasses
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from scipy.io import netcdf_file

from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.response import ResponseCurve
from microslip_mechanics.time_history import TimeHistory

if TYPE_CHECKING:
    from collections.abc import Iterable

    from matplotlib.figure import Figure

Result: TypeAlias = ResponseCurve | TimeHistory
Schema: TypeAlias = dict[str, tuple[tuple[str, ...], str, str]]
"""for each variable its dimensions, unit and meaning"""

CURVE: Schema = {
    "frequency": (("point",), "rad/s", "excitation frequency"),
    "amplitude": (("point", "probe"), "m", "first-harmonic amplitude"),
    "peak": (("point", "probe"), "m", "largest deviation from the mean in time"),
    "velocity_peak": (("point", "probe"), "m/s", "largest velocity in time"),
    "normal_smallest": (("point", "contact"), "N", "smallest normal force"),
    "normal_largest": (("point", "contact"), "N", "largest normal force"),
    "friction_energy": (("point",), "J", "energy taken out by friction per period"),
    "damping_energy": (
        ("point",),
        "J",
        "energy taken out by contact damping per period",
    ),
    "residual": (("point",), "N", "largest unbalanced force"),
    "outcome": (("point", "name"), "", "how Newton's correction ended"),
    "iterations": (("point",), "1", "Newton iterations"),
    "harmonics": (("point",), "1", "harmonics that were solved for"),
    "samples": (("point",), "1", "samples of the contacts per period"),
    "error": (("point",), "1", "estimated relative error of the amplitude"),
    "multiplier": (("point",), "1", "largest modulus of a Floquet multiplier"),
    "unstable": (("point",), "1", "Floquet multipliers outside the unit circle"),
    "event": (("point", "name"), "", "what the point is located as"),
    "parameter": (("point",), "SI", "what the curve is followed along"),
    "probes": (("probe", "name"), "", "what is watched"),
    "contacts": (("contact", "name"), "", "contact points"),
}
HISTORY: Schema = {
    "time": (("time",), "s", "time"),
    "displacement": (("time", "probe"), "m", "displacement"),
    "velocity": (("time", "probe"), "m/s", "velocity"),
    "normal_force": (("time", "contact"), "N", "normal contact force"),
    "friction_power": (("time",), "W", "power taken out by friction"),
    "energy": (("time", "energy"), "J", "energy that flowed so far, or is stored"),
    "probes": (("probe", "name"), "", "what is watched"),
    "contacts": (("contact", "name"), "", "contact points"),
    "energies": (("energy", "name"), "", "kinds of energy"),
}
SCHEMAS: dict[str, tuple[type[Result], Schema]] = {
    "frequency response curve": (ResponseCurve, CURVE),
    "time history": (TimeHistory, HISTORY),
}


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
    kind, schema = next(
        (kind, schema)
        for kind, (result, schema) in SCHEMAS.items()
        if isinstance(stored.result, result)
    )
    try:
        with netcdf_file(path, "w", version=2) as file:
            for name, value in _attributes(kind, stored).items():
                setattr(file, name, value)
            for name, values in _columns(stored.result, schema).items():
                dimensions, unit, meaning = schema[name]
                _dimensions(file, dimensions, values.shape)
                variable = file.createVariable(name, values.dtype, dimensions)
                variable[:] = values
                setattr(variable, "long_name", meaning)  # noqa: B010  (an attribute of the file)
                setattr(variable, "units", unit)  # noqa: B010
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


def load(path: Path) -> Stored:
    """Read a result that :func:`save` wrote.

    Raises
    ------
    StoreError
        If there is no such file, or it is not a result.
    """
    try:
        with netcdf_file(path, "r", mmap=False) as file:
            return _read(path, file)
    except FileNotFoundError:
        raise StoreError(f"there is no result file {path}") from None
    except OSError as error:
        raise StoreError(f"{path} cannot be read: {error.strerror or error}") from None
    except (TypeError, ValueError, KeyError, AttributeError, IndexError):
        raise StoreError(
            f"{path} is not a result file: give what frc or sweep wrote"
        ) from None


def _attributes(kind: str, stored: Stored) -> dict[str, object]:
    """Return the global attributes of the file."""
    made: dict[str, object] = {
        "kind": kind,
        "source": f"microslip {version('microslip')}",
        "command": stored.command,
        "scene": stored.scene,
    }
    for field in dataclasses.fields(stored.result):
        made[field.name] = getattr(stored.result, field.name)
    return {name: _attribute(value) for name, value in made.items() if _single(value)}


def _single(value: object) -> bool:
    return isinstance(value, (str, int, float))


def _attribute(value: object) -> object:
    """Return UTF-8 bytes or a number of full precision."""
    if isinstance(value, str):
        return value.encode()
    return np.float64(value) if isinstance(value, float) else value


def _columns(result: Result, schema: Schema) -> dict[str, np.ndarray]:
    """Return what the file holds of each variable; those without content are left out.

    A dimension of length zero would be netCDF 3's sign for an unlimited one.
    """
    found = {name: getattr(result, name) for name in schema}
    names = [
        each for value in found.values() if isinstance(value, tuple) for each in value
    ]
    longest = max((len(name.encode()) for name in names), default=0)
    plain = {name: _plain(value, max(1, longest)) for name, value in found.items()}
    return {name: values for name, values in plain.items() if values.size}


def _plain(value: object, longest: int) -> np.ndarray:
    """Return an array that netCDF 3 knows: float64, or characters for names."""
    if isinstance(value, tuple):
        names = np.array([name.encode() for name in value], dtype=f"S{longest}")
        return names.view("S1").reshape(len(value), longest)
    return np.asarray(value, dtype=float)


def _dimensions(
    file: netcdf_file, names: tuple[str, ...], shape: tuple[int, ...]
) -> None:
    for name, size in zip(names, shape, strict=True):
        if name not in file.dimensions:
            file.createDimension(name, size)


def _read(path: Path, file: netcdf_file) -> Stored:
    kind, scene, command = (
        getattr(file, name).decode() for name in ("kind", "scene", "command")
    )
    if kind not in SCHEMAS:
        raise StoreError(f"{path} holds a {kind!r}, which this version does not know")
    result, schema = SCHEMAS[kind]
    made: dict[str, Any] = {}
    for field in dataclasses.fields(result):
        if field.name in schema:
            dimensions, *_ = schema[field.name]
            made[field.name] = _variable(file, field.name, dimensions)
        else:
            value = getattr(file, field.name)
            made[field.name] = (
                value.decode() if isinstance(value, bytes) else value.item()
            )
    return Stored(result(**made), scene, command)


def _variable(file: netcdf_file, name: str, dimensions: tuple[str, ...]) -> object:
    """Return names as a tuple of texts, numbers as float64 in native order.

    What the file leaves out is empty, if one of its dimensions is.
    """
    sizes = [file.dimensions.get(each) or 0 for each in dimensions]
    if name not in file.variables and 0 in sizes:
        return () if "name" in dimensions else np.zeros(sizes)
    data = file.variables[name].data
    if data.dtype.kind == "S":
        rows = np.ascontiguousarray(data).view(f"S{data.shape[-1]}")
        return tuple(text.decode() for text in rows.ravel())
    return data.astype(float)
