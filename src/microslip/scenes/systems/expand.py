"""Sets of nodes in a scene: one element for each node, or for each pair of nodes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microslip.quantity import SceneError
from microslip.table import meant, shown
from microslip_mechanics.element import KEYS


def expanded(
    source: str,
    number: int,
    values: dict[str, Any],
    sets: Mapping[str, tuple[str, ...]],
) -> list[dict[str, Any]]:
    """Return a table [[element]] once for each node of the sets named by ``each``.

    In its ends ``set.direction`` stands for the node of the set whose turn it is; the
    name gets the node of the first set behind it.

    Raises
    ------
    SceneError
        If a set is unknown, or if sets that go together differ in length.
    """
    if "each" not in values:
        return [values]
    place = f"{source}: element {values.get('name', number)}: each"
    named = values["each"]
    if not isinstance(named, list) or not named:
        raise SceneError(
            f'{place}{shown(named)}: give a list of sets, such as ["face"]'
        )
    for name in named:
        if name not in sets:
            hint = meant(str(name), list(sets)) if sets else ": add [structure.sets]"
            raise SceneError(f"{place}: there is no set {name!r}{hint}")
    if len({len(sets[name]) for name in named}) > 1:
        sizes = ", ".join(f"{name} has {len(sets[name])}" for name in named)
        raise SceneError(f"{place}: {sizes} nodes: give sets of as many nodes")
    made = []
    for nodes in zip(*(sets[name] for name in named), strict=True):
        turn = dict(zip(named, nodes, strict=True))
        one = {key: value for key, value in values.items() if key != "each"}
        one |= {key: _put(one[key], turn) for key in KEYS if key in one}
        one["name"] = f"{values.get('name', f'element-{number}')}.{nodes[0]}"
        made.append(one)
    return made


def _put(ends: object, turn: Mapping[str, str]) -> object:
    """Return ends with the nodes in place of their sets."""
    if isinstance(ends, list):
        return [_put(each, turn) for each in ends]
    if isinstance(ends, dict):
        return {_put(key, turn): factor for key, factor in ends.items()}
    if isinstance(ends, str):
        group, dot, direction = ends.rpartition(".")
        return f"{turn[group]}.{direction}" if dot and group in turn else ends
    return ends
