"""The value of a key in the tables of a rig: of elements and loads alike."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any

from microslip.scenes.key_path import AMPLITUDE


def reached(tables: Any, path: Sequence[str]) -> Any:  # noqa: ANN401  (dataclass or table)
    """Return what stands at a path; None if there is nothing."""
    for part in path:
        inner = isinstance(tables, Mapping)
        tables = tables.get(part) if inner else getattr(tables, part, None)
    return getattr(tables, AMPLITUDE, tables)


def replaced(tables: Any, path: Sequence[str], value: float) -> Any:  # noqa: ANN401
    """Return tables with another number at a path."""
    if not path:
        shorthand = hasattr(tables, AMPLITUDE)
        return replaced(tables, (AMPLITUDE,), value) if shorthand else value
    first, *rest = path
    if isinstance(tables, Mapping):
        return {**tables, first: replaced(tables[first], rest, value)}
    inner = replaced(getattr(tables, first), rest, value)
    return dataclasses.replace(tables, **{first: inner})


def unit(tables: Any, path: Sequence[str]) -> str:  # noqa: ANN401
    """Return the SI unit of the number at a path; empty if it has none.

    That of a stiffness follows from its exponent.
    """
    holder = _table(tables, path[:-1])
    if isinstance(holder, Mapping):
        inner = holder[path[-1]]
        return unit(inner, (AMPLITUDE,)) if hasattr(inner, AMPLITUDE) else "N"
    fields = {field.name: field for field in dataclasses.fields(holder)}
    kind = fields[path[-1]].metadata["quantity"]
    exponent = path[-1].replace("stiffness", "exponent")
    return str(kind.of_power(getattr(holder, exponent, None)).unit)


def _table(tables: Any, path: Sequence[str]) -> Any:  # noqa: ANN401
    for part in path:
        inner = isinstance(tables, Mapping)
        tables = tables[part] if inner else getattr(tables, part)
    return tables
