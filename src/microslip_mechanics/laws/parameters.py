"""The numbers of a law in words: units, ranges, and what stands for one left out."""

from __future__ import annotations

import dataclasses
import inspect
from typing import Any

HEAD = "\n\nParameters\n----------\n"
"""of the section on numbers in the docstring of a law"""


def described(law: type[Any]) -> str | None:
    """Return the docstring of a law with a section on its numbers; none without one."""
    if law.__doc__ is None:  # by python -OO
        return None
    lines = [line for each in dataclasses.fields(law) for line in _lines(each)]
    return inspect.cleandoc(law.__doc__) + HEAD + "\n".join(lines)


def _lines(field: dataclasses.Field[Any]) -> tuple[str, str]:
    """Return the lines of one number."""
    unit, default = field.metadata["quantity"].unit, left_out(field)
    words = [f"[{unit}]"] if unit else []
    words += [values(field)] if values(field) else []
    words += [f"{default} if left out"] if default != "must be given" else []
    return field.name, f"    {', '.join(words)}"


def left_out(field: dataclasses.Field[Any]) -> str:
    """Return what stands for a number that is left out."""
    told = field.metadata["told"]
    if told:
        return str(told[1])
    if field.default is dataclasses.MISSING:
        return "must be given"
    return "none" if field.default is None else str(field.default).lower()


def values(field: dataclasses.Field[Any]) -> str:
    """Return what a number may be."""
    kind, told = field.metadata["quantity"], field.metadata["told"]
    if told and told[0]:
        return str(told[0])
    if field.type == "bool":
        return "`true` or `false`"
    if "Mapping" in str(field.type):
        return "a table: number for each power"
    parts = []
    if kind.lowest > float("-inf"):
        parts.append(f"{'above' if kind.positive else 'at least'} {kind.lowest:g}")
    if kind.highest < float("inf"):
        parts.append(f"at most {kind.highest:g}")
    return ", ".join(parts) or "any"
