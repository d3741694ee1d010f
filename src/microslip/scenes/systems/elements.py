"""The tables [[element]] of a scene of kind ``system``."""

from __future__ import annotations

from typing import Any

from microslip.scenes.quantity import SceneError
from microslip.scenes.systems.expand import expanded
from microslip.scenes.table import meant, read_table, shown, written
from microslip_mechanics.element import KEYS
from microslip_mechanics.laws.catalogue import LAWS


def read_elements(
    source: str, given: object, sets: dict[str, tuple[str, ...]]
) -> tuple[dict[str, Any], dict[str, dict[str, dict[str, Any]]]]:
    """Return the law of each element, and directions by its name and by its node.

    Raises
    ------
    SceneError
        With source, element, key and remedy.
    """
    if not isinstance(given, list):
        raise SceneError(
            f"{source}: [element] is one table: write [[element]], once for each"
        )
    laws: dict[str, Any] = {}
    ends: dict[str, dict[str, dict[str, Any]]] = {}
    for number, values in enumerate(given, start=1):
        if not isinstance(values, dict):
            raise SceneError(
                f"{source}: [[element]] must be a table, not {written(values)}"
            )
        left = dict(values)
        named = left.pop("each", None)
        name, law, directions = _element(source, number, left)
        if name in laws:
            raise SceneError(
                f"{source}: two elements are named {name}: give each its own name"
            )
        laws[name] = law
        ends[name] = expanded(source, name, named, directions, sets)
    return laws, ends


def _element(
    source: str, number: int, values: dict[str, Any]
) -> tuple[str, Any, dict[str, Any]]:
    """Return name, law and directions of an element."""
    left = dict(values)
    name = left.pop("name", f"element-{number}")
    law = left.pop("law", None)
    if not isinstance(name, str) or not name:
        raise SceneError(f"{source}: [[element]] name{shown(name)}: give a text")
    if law is None:
        raise SceneError(
            f"{source}: element {name}: law is missing: give one of {', '.join(LAWS)}"
        )
    if not isinstance(law, str) or law not in LAWS:
        hint = meant(str(law), list(LAWS))
        raise SceneError(f"{source}: element {name}: law{shown(law)} is unknown{hint}")
    given = {key: left.pop(key) for key in KEYS if key in left}
    for key in KEYS[2:]:
        if key in given and not isinstance(given[key], list):
            raise SceneError(
                f"{source}: element {name}: {key}{shown(given[key])}: give a list of "
                'pairs, such as [["x1", "ground"]]'
            )
    try:
        made = read_table(source, f"element {name}: ", LAWS[law], left, KEYS)
    except ValueError as error:
        raise SceneError(f"{source}: element {name}: {error}") from None
    return name, made, given
