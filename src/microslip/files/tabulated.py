"""A result as the columns of a table."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from microslip.files.schema import REPEATED, Result, Schema, kind_of
from microslip.files.store import save_table

ALONG = ("point", "time", "cycle")
"""dimensions of which each place is a row"""
EACH = {"probe": "probes", "contact": "contacts", "energy": "energies"}
"""for each dimension that has a column for each of its places: where their names are"""


def save_columns(path: Path, result: Result) -> None:
    """Write the columns of a curve or a march as CSV.

    Raises
    ------
    StoreError
        If the file cannot be written.
    """
    save_table(path, *tabulated(result))


def tabulated(result: Result) -> tuple[list[str], Iterator[tuple[object, ...]]]:
    """Return the heads of the columns of a curve or a march, and its rows.

    A head is the name of a variable, what it is of, and its unit. What only repeats
    another variable is left out.
    """
    _, schema = kind_of(result)
    columns = dict(_columns(result, schema))
    return list(columns), zip(*columns.values(), strict=True)


def _columns(result: Result, schema: Schema) -> Iterator[tuple[str, list[object]]]:
    """Yield the head of each column, and its values."""
    for name, (dimensions, unit, _) in schema.items():
        values = getattr(result, name)
        if dimensions[0] not in ALONG or _repeats(result, name):
            continue
        if unit == "SI":
            along = getattr(result, "along", "")
            name, unit = (f"{name} of {along}", "") if along else (name, "rad/s")
        ending = f" [{unit}]" if unit not in ("", "1") else ""
        if dimensions[1:] and dimensions[1] in EACH:
            names = getattr(result, EACH[dimensions[1]])
            for each, column in zip(names, np.asarray(values).T, strict=True):
                yield f"{name} {each}{ending}", column.tolist()
        elif len(values):
            yield f"{name}{ending}", list(np.asarray(values).tolist())


def _repeats(result: Result, name: str) -> bool:
    """Return whether a variable is the same as another one at all places."""
    if name not in REPEATED:
        return False
    one, other = (getattr(result, each) for each in (name, REPEATED[name]))
    return np.array_equal(one, other, equal_nan=True)
