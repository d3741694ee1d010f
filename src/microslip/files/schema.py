"""What result files hold; docs/files.md describes it."""

from __future__ import annotations

import dataclasses
from typing import Any, TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory

Growing: TypeAlias = TimeHistory | Envelope
"""results that a march adds to"""
Result: TypeAlias = ResponseCurve | Growing
Schema: TypeAlias = dict[str, tuple[tuple[str, ...], str, str]]
"""for each variable its dimensions, unit and meaning"""

CURVE: Schema = {
    "frequency": (("point",), "rad/s", "excitation frequency"),
    "amplitude": (("point", "probe"), "m", "first-harmonic amplitude"),
    "amplitude_lowest": (("point", "probe"), "m", "by other residual tractions"),
    "amplitude_highest": (("point", "probe"), "m", "by other residual tractions"),
    "peak": (("point", "probe"), "m", "half of the way from least to largest in time"),
    "velocity_peak": (("point", "probe"), "m/s", "largest velocity in time"),
    "normal_smallest": (("point", "contact"), "N", "smallest normal force"),
    "normal_largest": (("point", "contact"), "N", "largest normal force"),
    "friction_energy": (("point",), "J", "energy taken out by friction per period"),
    "damping_energy": (
        ("point",),
        "J",
        "energy taken out by contact damping per period",
    ),
    "friction_energy_error": (("point",), "J", "estimated error of friction's energy"),
    "damping_energy_error": (("point",), "J", "estimated error of damping's energy"),
    "normal_error": (("point", "contact"), "N", "estimated error of these forces"),
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
    "parameter_error": (("point",), "SI", "estimated error of an event"),
    "probes": (("probe", "name"), "", "what is watched"),
    "contacts": (("contact", "name"), "", "contact points"),
}
REPEATED = {"amplitude_lowest": "amplitude", "amplitude_highest": "amplitude"}
"""variables that are left out where they are the same as another one"""
NAMES: Schema = {
    "probes": (("probe", "name"), "", "what is watched"),
    "contacts": (("contact", "name"), "", "contact points"),
    "energies": (("energy", "name"), "", "kinds of energy"),
    "checkpoint": (("state",), "SI", "rows, dofs and state, to go on from"),
}
"""what does not grow with a march; the checkpoint is the last of it in a file"""
HISTORY: Schema = {
    **NAMES,
    "time": (("time",), "s", "time"),
    "frequency": (("time",), "rad/s", "frequency of the drive"),
    "level": (("time",), "1", "amplitude of the drive's sine over the scene's"),
    "displacement": (("time", "probe"), "m", "displacement"),
    "velocity": (("time", "probe"), "m/s", "velocity"),
    "normal_force": (("time", "contact"), "N", "normal contact force"),
    "friction_power": (("time",), "W", "power taken out by friction"),
    "energy": (("time", "energy"), "J", "energy that flowed so far, or is stored"),
    "energy_error": (("time",), "J", "estimated error of friction's energy"),
    "peak_error": (("time",), "1", "estimated relative error of the largest amplitude"),
    "work_difference": (("time",), "J", "friction's work less that by another way"),
}
ENVELOPE: Schema = {
    **NAMES,
    "time": (("cycle",), "s", "end of the cycle"),
    "frequency": (("cycle",), "rad/s", "frequency of the drive"),
    "level": (("cycle",), "1", "amplitude of the drive's sine over the scene's"),
    "highest": (("cycle", "probe"), "m", "largest displacement"),
    "lowest": (("cycle", "probe"), "m", "smallest displacement"),
    "fastest": (("cycle", "probe"), "m/s", "largest absolute velocity"),
    "normal_smallest": (("cycle", "contact"), "N", "smallest normal force"),
    "normal_largest": (("cycle", "contact"), "N", "largest normal force"),
    "energy": (("cycle", "energy"), "J", "energy that flowed so far, or is stored"),
    "energy_error": (("cycle",), "J", "estimated error of friction's energy"),
    "peak_error": (
        ("cycle",),
        "1",
        "estimated relative error of the largest amplitude",
    ),
    "work_difference": (("cycle",), "J", "friction's work less that by another way"),
}
SCHEMAS: dict[str, tuple[type[Result], Schema]] = {
    "frequency response curve": (ResponseCurve, CURVE),
    "time history": (TimeHistory, HISTORY),
    "envelope": (Envelope, ENVELOPE),
}
GROWS = {"time history": "time", "envelope": "cycle"}
"""the dimension along which a kind grows"""


def kind_of(result: Result) -> tuple[str, Schema]:
    """Return kind and schema of a result."""
    return next(
        (kind, schema)
        for kind, (made, schema) in SCHEMAS.items()
        if isinstance(result, made)
    )


def columns(result: Result, schema: Schema) -> dict[str, np.ndarray]:
    """Return what the file holds of each variable; those without content are left out.

    A dimension of length zero would be netCDF 3's sign for an unlimited one. So is what
    only repeats another variable.
    """
    found = {name: getattr(result, name) for name in schema}
    for name, other in REPEATED.items():
        if name in found and np.array_equal(found[name], found[other], equal_nan=True):
            del found[name]
    names = [
        each for value in found.values() if isinstance(value, tuple) for each in value
    ]
    longest = max((len(name.encode()) for name in names), default=0)
    plain = {name: _plain(value, max(1, longest)) for name, value in found.items()}
    return {name: values for name, values in plain.items() if values.size}


def _plain(value: object, longest: int) -> np.ndarray:
    """Return an array that netCDF 3 knows: float64, or characters for names."""
    if value is None:
        return np.zeros(0)
    if isinstance(value, Checkpoint):
        return flat(value, 0)
    if isinstance(value, tuple):
        names = np.array([name.encode() for name in value], dtype=f"S{longest}")
        return names.view("S1").reshape(len(value), longest)
    return np.asarray(value, dtype=float)


def flat(checkpoint: Checkpoint, rows: int) -> Array:
    """Return a checkpoint behind so many rows as one array."""
    sizes = [rows, checkpoint.displacement.size]
    motion = (checkpoint.displacement, checkpoint.velocity)
    return np.concatenate([sizes, *motion, checkpoint.memory])


def checkpoint_of(numbers: Array) -> Checkpoint:
    """Return the checkpoint that :func:`flat` laid out."""
    dofs = int(numbers[1])
    displacement, velocity, memory = np.split(numbers[2:], [dofs, 2 * dofs])
    return Checkpoint(displacement.copy(), velocity.copy(), memory.copy())


def attributes(result: Result) -> dict[str, str | int | float]:
    """Return the fields that are one text or number."""
    made: dict[str, Any] = {
        field.name: getattr(result, field.name) for field in dataclasses.fields(result)
    }
    return {name: each for name, each in made.items() if _single(each)}


def _single(value: object) -> bool:
    return isinstance(value, (str, int, float))


def names_of(data: np.ndarray) -> tuple[str, ...]:
    """Return the texts of a variable of characters."""
    rows = np.ascontiguousarray(data).view(f"S{data.shape[-1]}")
    return tuple(text.decode() for text in rows.ravel())
