"""Values that are none, in place of every number of a scene."""

from __future__ import annotations

import dataclasses
import typing

from microslip.scenes.experiments import Curve, March, Sweep
from microslip.scenes.two_blades.tables import TwoBlades
from microslip.studies.stress.case import Case

BAD = ("nan", "inf", "-inf", "1e999", "1e308")
"""the last is a number: the curve that is made of it must be finite, or one line"""


def bad_values() -> list[Case]:
    """Return, for each table, every number of it replaced by each bad value."""
    tables = {
        "sweep": _numbers(Sweep),
        "curve": _numbers(Curve),
        "march": _numbers(March),
    }
    for table, hint in typing.get_type_hints(TwoBlades).items():
        kinds = [each for each in _kinds(hint) if dataclasses.is_dataclass(each)]
        tables[table] = [key for kind in kinds for key in _numbers(kind)]
    return [
        Case(bad, table, (), refusals=tuple((f"{table}.{key}={bad}",) for key in keys))
        for bad in BAD
        for table, keys in tables.items()
        if keys
    ]


def _numbers(table: typing.Any) -> list[str]:  # noqa: ANN401  (a dataclass)
    """Return the names of the numbers, and lists of them, in a table of scenes."""
    hints = typing.get_type_hints(table)
    return [
        field.name
        for field in dataclasses.fields(table)
        if "quantity" in field.metadata
        and {float, int} & {hints[field.name], *_kinds(hints[field.name])}
    ]


def _kinds(hint: object) -> tuple[object, ...]:
    return typing.get_args(hint) or (hint,)
