"""Sets of nodes, by whose names loads act on all of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from microslip_mechanics.structures.selection import selected

Sets: TypeAlias = Mapping[str, Sequence[str]]
"""nodes, by the name of their set"""


def given_sets(given: Sets | None, names: tuple[str, ...]) -> Sets:
    """Return sets of nodes as they are given, none if they are left out.

    ``names`` are those of the degrees of freedom.

    Raises
    ------
    ValueError
        If they are no table of lists of texts, if a node is unknown, or if a set has
        the name of a node.
    """
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
            f"sets = {given!r}: give nodes by the name of their set, such as "
            '{"face": ["12", "13"]}'
        )
    for name, nodes in given.items():
        if not texts(nodes) or not len(nodes):
            raise ValueError(
                f"sets: {name} = {nodes!r}: give a list of nodes as texts, such as "
                '["12", "13"]'
            )
    _check_nodes(given, names)
    return given


def _check_nodes(sets: Sets, names: tuple[str, ...]) -> None:
    """Check that a set has nodes that there are, and no node's name."""
    known = {name.rpartition(".")[0] for name in names}.union(names)
    for group, nodes in sets.items():
        if group in known and list(nodes) != [group]:
            raise ValueError(
                f"sets: {group} is the name of a node, too: name the set differently"
            )
        try:
            selected(names, [node for node in nodes if node not in known])
        except ValueError as error:
            raise ValueError(f"sets: {group}: {error}") from None


def members(name: str, names: tuple[str, ...], sets: Sets, what: str) -> list[str]:
    """Return the degrees of freedom that a name stands for, ``what`` being its use.

    Raises
    ------
    ValueError
        If a set has a node twice.
    """
    group, _, direction = str(name).rpartition(".")  # what is no text is refused later
    if name in names or group not in sets:
        return [name]
    twice = [node for node, count in Counter(sets[group]).items() if count > 1]
    if twice:
        raise ValueError(
            f"{what} of {name}: node {twice[0]} stands in the set {group} more than "
            "once, and would be loaded so many times: give each node once"
        )
    return [f"{node}.{direction}" for node in sets[group]]


def texts(given: object) -> bool:
    """Return whether these are texts in a row."""
    if isinstance(given, str) or not isinstance(given, Sequence | np.ndarray):
        return False
    return all(isinstance(each, str) for each in given)
