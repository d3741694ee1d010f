"""Dataclasses from TOML tables, as their annotations and quantities say."""

from __future__ import annotations

import dataclasses
import difflib
import types
import typing
from collections.abc import Mapping

from microslip.scenes.quantity import Quantity, SceneError


def read_table(
    source: str,
    place: str,
    table: type,
    values: object,
    known: typing.Sequence[str] = (),
) -> typing.Any:  # noqa: ANN401  (an instance of ``table``)
    """Make a dataclass from a TOML table; ``known`` are more names to suggest."""
    if not isinstance(values, dict):
        raise SceneError(f"{source}: {place}must be a table, not {written(values)}")
    hints = typing.get_type_hints(table)
    fields = {field.name: field for field in dataclasses.fields(table)}
    for key in values:
        if key not in fields:
            raise SceneError(
                f"{source}: {place}{key}{shown(values[key])} is unknown"
                f"{meant(key, [*fields, *known])}"
            )
    missing = [
        name if "quantity" in field.metadata else f"table {_inside(place, name)}"
        for name, field in fields.items()
        if name not in values and field.default is dataclasses.MISSING
    ]
    if missing:
        lacks = "is missing: add it" if len(missing) == 1 else "are missing: add them"
        raise SceneError(f"{source}: {place}{', '.join(missing)} {lacks}")
    return table(
        **{
            name: _value(
                source, place, name, _kind(fields, values, name), hints[name], value
            )
            for name, value in values.items()
        }
    )


def _inside(place: str, key: str) -> str:
    """Return the name of a table in a table, such as ``[structure.beam]``."""
    outer = place.strip().removeprefix("[").removesuffix("]")
    return f"[{outer}.{key}]" if place.startswith("[") else f"[{key}]"


def _kind(
    fields: Mapping[str, dataclasses.Field[typing.Any]],
    values: Mapping[str, object],
    name: str,
) -> Quantity | None:
    """Return what a key may be; the unit of a stiffness follows from its exponent."""
    kind: Quantity | None = fields[name].metadata.get("quantity")
    exponent = fields.get(name.replace("stiffness", "exponent"))
    if kind is None or exponent is None:
        return kind
    return kind.of_power(values.get(exponent.name, exponent.default))


def _value(
    source: str,
    place: str,
    key: str,
    kind: Quantity | None,
    hint: typing.Any,  # noqa: ANN401  (a type annotation)
    value: object,
) -> object:
    """Read one key as its annotation says."""
    if _optional(hint):
        hint = typing.get_args(hint)[0]
    if kind is None:  # a table in the table
        inner = _inside(place, key)
        return read_table(source, f"{inner} ", typing.cast("type", hint), value)
    try:
        return _scalar(kind, hint, value)
    except ValueError as error:
        name = f"{place}{key}{shown(value)}"
        raise SceneError(f"{source}: {name}: {error}") from None


def _scalar(
    kind: Quantity,
    hint: typing.Any,  # noqa: ANN401  (a type annotation)
    value: object,
) -> object:
    """Return a choice, a list, a text or a number."""
    if typing.get_origin(hint) is typing.Literal:
        choices = typing.get_args(hint)
        if value not in choices:
            raise ValueError(f"is unknown: give one of {', '.join(choices)}")
        return value
    if typing.get_origin(hint) is Mapping:
        return _by_power(kind, value)
    if typing.get_origin(hint) is tuple:
        texts = typing.get_args(hint)[0] is str
        return _texts(value) if texts else _several(kind, value)
    if hint is str:
        if not isinstance(value, str) or not value:
            raise ValueError("is not a text: give one in quotes")
        return value
    return _number(kind, hint, value)


def _number(kind: Quantity, hint: type, value: object) -> object:
    """Return a switch, a whole number or a quantity in SI units."""
    if hint is bool:
        if not isinstance(value, bool):
            raise ValueError("is not a switch: give true or false")
        return value
    number = kind.read(value)
    if hint is int:
        if number != int(number):
            raise ValueError("is not a whole number: give one")
        return int(number)
    return number


def _by_power(kind: Quantity, value: object) -> dict[float, float]:
    """Return numbers by the power to which they belong."""
    if not isinstance(value, dict):
        raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
            "is no table: give a number for each power, such as {1 = 10, 3 = 2e6}"
        )
    return {
        _power(power): kind.of_power(_power(power)).read(each)
        for power, each in value.items()
    }


def _power(text: str) -> float:
    """Return a power that is the key of its number."""
    try:
        return float(text)
    except ValueError:
        raise ValueError(
            f"power {text} is no number: give powers such as {{1 = 10, 3 = 2e6}}"
        ) from None


def _several(kind: Quantity, value: object) -> tuple[float, ...]:
    """Return one number or a list of them as a tuple."""
    if isinstance(value, dict):
        raise ValueError("is a table: give numbers in brackets")  # noqa: TRY004
    several = value if isinstance(value, list) else [value]
    if not several:
        raise ValueError("is empty: give at least one number")
    return tuple(kind.read(each) for each in several)


def _texts(value: object) -> tuple[str, ...]:
    """Return a list of texts as a tuple."""
    if not isinstance(value, list) or not all(isinstance(each, str) for each in value):
        raise ValueError("is no list of texts: give one")
    return tuple(value)


def read_numbers(
    source: str, table: str, values: object, kind: Quantity
) -> dict[str, float]:
    """Return a table of numbers of one kind."""
    if not isinstance(values, dict):
        raise SceneError(f"{source}: [{table}] must be a table, not {written(values)}")
    found = {}
    for name, value in values.items():
        try:
            found[name] = kind.read(value)
        except ValueError as error:
            raise SceneError(
                f"{source}: [{table}] {name}{shown(value)}: {error}"
            ) from None
    return found


def shown(value: object) -> str:
    """Return `` = value`` for a message; a table has too much to show."""
    if isinstance(value, dict):
        return ""
    text = written(value)
    return f" = {text if len(text) <= 60 else text[:60] + '…'}"


def written(value: object) -> str:
    """Return a value as a scene file has it."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(written(each) for each in value)}]"
    return f'"{value}"' if isinstance(value, str) else str(value)


def _optional(hint: typing.Any) -> bool:  # noqa: ANN401  (a type annotation)
    return isinstance(hint, types.UnionType) and types.NoneType in typing.get_args(hint)


def meant(key: str, names: typing.Sequence[str]) -> str:
    """Return what may have been meant, to end a message."""
    close = difflib.get_close_matches(key, names, n=1)
    if close:
        return f": do you mean {close[0]}?"
    return f": give one of {', '.join(names)}"
