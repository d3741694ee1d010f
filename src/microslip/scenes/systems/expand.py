"""Sets of nodes in a scene: one element for each node, or for each pair of nodes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from microslip.scenes.quantity import SceneError
from microslip.scenes.table import meant, shown


def expanded(
    source: str,
    name: str,
    each: object,
    directions: dict[str, Any],
    sets: Mapping[str, tuple[str, ...]],
) -> dict[str, dict[str, Any]]:
    """Return the directions of an element, once for each node of the sets in ``each``.

    In its ends ``set.direction`` stands for the node of the set whose turn it is; the
    name gets the node of the first set behind it.

    Raises
    ------
    SceneError
        If a set is unknown, or if sets that go together differ in length.
    """
    if each is None:
        return {name: directions}
    place = f"{source}: element {name}: each"
    if not isinstance(each, list) or not each:
        raise SceneError(f'{place}{shown(each)}: give a list of sets, such as ["face"]')
    for group in each:
        if not isinstance(group, str) or group not in sets:
            hint = meant(str(group), list(sets)) if sets else ": add [structure.sets]"
            raise SceneError(f"{place}: there is no set {group!r}{hint}")
    if len({len(sets[group]) for group in each}) > 1:
        sizes = ", ".join(f"{group} has {len(sets[group])}" for group in each)
        raise SceneError(f"{place}: {sizes} nodes: give sets of as many nodes")
    made = {}
    for nodes in zip(*(sets[group] for group in each), strict=True):
        turn = dict(zip(each, nodes, strict=True))
        put = {key: _put(ends, turn) for key, ends in directions.items()}
        made[f"{name}-{nodes[0]}"] = put
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
