"""A response curve, back from an open netCDF file."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from scipy.io import netcdf_file

from microslip.files.schema import CURVE, REPEATED, names_of
from microslip_mechanics.results.response_curve import ResponseCurve

LATER = (
    "parameter_error",
    "friction_energy_error",
    "damping_energy_error",
    "normal_error",
)
"""what files of earlier versions do not have"""


def stored_curve(file: netcdf_file) -> ResponseCurve:
    """Return the curve that a file holds.

    Raises
    ------
    KeyError, ValueError, AttributeError
        If something is missing, or places and amplitudes are no finite numbers.
    """
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
    for name in ("frequency", "parameter", "amplitude"):
        if not np.isfinite(made[name]).all():
            raise ValueError(f"{name} is not finite")
    return ResponseCurve(**made)


def _variable(file: netcdf_file, name: str, dimensions: tuple[str, ...]) -> object:
    """Return names as a tuple of texts, numbers as float64 in native order.

    What the file leaves out is empty, if one of its dimensions is.
    """
    sizes = [file.dimensions.get(each) or 0 for each in dimensions]
    if name not in file.variables and 0 in sizes:
        return () if "name" in dimensions else np.zeros(sizes)
    if name not in file.variables and name in REPEATED:
        return _variable(file, REPEATED[name], dimensions)
    if name not in file.variables and name in LATER:
        return np.full(sizes, np.nan)
    data = file.variables[name].data
    return names_of(data) if data.dtype.kind == "S" else data.astype(float)
