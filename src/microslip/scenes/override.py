"""Overrides: single values of a scene's document, replaced."""

from __future__ import annotations

import tomllib
import typing

from microslip.scenes.key_path import AMPLITUDE, key_path
from microslip.scenes.quantity import SceneError
from microslip.scenes.table import meant, shown

NESTED = (["element"], ["drive"], ["structure"])
"""tables of a system with tables in them"""


def apply_override(document: dict[str, typing.Any], override: str) -> None:
    """Put one ``table.key=value`` into the document.

    Raises
    ------
    SceneError
        If it is no such text, or there is no such place.
    """
    name, equals, text = override.partition("=")
    *tables, key = key_path(name)
    deepest = 2 if tables[:1] in NESTED else 1
    if not equals or not key or len(tables) > deepest or not all(tables):
        raise SceneError(f"--set {override}: {_wanted(document, tables, key, equals)}")
    value = _value(text)
    place = document
    for table in tables:
        place = _inner(place, table, override)
        if not isinstance(place, dict):
            raise SceneError(
                f"--set {override}: {table}{shown(place)} has no keys: give "
                f"{name.partition(table)[0]}{table} as a whole"
            )
    held = place.get(key) if tables == ["drive"] else None
    if isinstance(held, dict) and AMPLITUDE in held and not isinstance(value, dict):
        value = {**held, AMPLITUDE: value}
    place[key] = value


def _wanted(
    document: dict[str, typing.Any], tables: list[str], key: str, equals: str
) -> str:
    """Return what is wrong with an override that leads to no place."""
    held = [name for name, value in document.items() if isinstance(value, dict | list)]
    if equals and key and len(tables) == 2 and all(tables) and tables[0] not in held:
        return f"the scene has no table {tables[0]}{meant(tables[0], held)}"
    return "give table.key=value, such as contact.sigma=3e-7"


def _value(text: str) -> typing.Any:  # noqa: ANN401  (whatever TOML may hold)
    """Return a value of the command line: TOML, a number such as .5 or 5., a text."""
    try:
        parsed = tomllib.loads(f"value = {text}")
    except (ValueError, RecursionError):
        parsed = {}
    if len(parsed) == 1:
        return parsed["value"]
    try:
        return float(text)
    except ValueError:
        return text.strip()


def _inner(place: dict[str, typing.Any], table: str, override: str) -> typing.Any:  # noqa: ANN401
    """Return the table of a name within another, or the element of that name."""
    elements = place.get("element")
    if table != "element" or not isinstance(elements, list):
        return place.setdefault(table, {})
    named = {
        each.get("name", f"element-{number}"): each
        for number, each in enumerate(elements, start=1)
        if isinstance(each, dict)
    }
    _, name, *rest = key_path(override.partition("=")[0])
    if not rest:
        raise SceneError(f"--set {override}: give element.NAME.KEY=value")
    if name not in named:
        raise SceneError(
            f"--set {override}: there is no element {name}"
            f"{meant(name, [str(each) for each in named])}"
        )
    return named
