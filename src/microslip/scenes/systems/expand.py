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
    name gets the node of the first set behind it, and those of the others too where
    that one stands there more than once.

    Raises
    ------
    SceneError
        If a set is unknown or not used, or if sets that go together differ in length
        or have the same nodes twice.
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
    rows = list(zip(*(sets[group] for group in each), strict=True))
    once = len(set(sets[each[0]])) == len(rows)
    made: dict[str, dict[str, Any]] = {}
    for nodes in rows:
        turn = dict(zip(each, nodes, strict=True))
        put = {key: _put(ends, turn) for key, ends in directions.items()}
        called = "-".join((name, *nodes[: 1 if once else None]))
        if called in made:
            raise SceneError(
                f"{place}: {', '.join(nodes)} stand together twice: name them once"
            )
        made[called] = put
    _check_used(place, each, directions)
    return made


def _check_used(place: str, each: list[str], directions: dict[str, Any]) -> None:
    """Check that each set stands in a direction."""
    for group in each if directions else ():
        if all(_put(ends, {group: ""}) == ends for ends in directions.values()):
            raise SceneError(
                f"{place}: no direction has an end of the set {group}, such as "
                f'"{group}.x": write one, or leave the set out'
            )


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
