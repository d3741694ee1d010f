"""Degrees of freedom chosen by name, by pattern or by a set of nodes."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from fnmatch import fnmatchcase

import numpy as np
from numpy.typing import NDArray

NO_SETS: Mapping[str, Sequence[str]] = {}


def selected(
    names: Sequence[str],
    patterns: Sequence[str],
    sets: Mapping[str, Sequence[str]] = NO_SETS,
) -> NDArray[np.int64]:
    """Return the places of the degrees of freedom that any pattern matches.

    Parameters
    ----------
    names
        Of all degrees of freedom, ``node.direction``.
    patterns
        A name, a node (all its directions), a pattern such as ``tip.*`` or ``1?.z``, or
        the name of a set.
    sets
        Names of sets of nodes, and the patterns in each.

    Returns
    -------
    In the order of ``names``, each once.

    Raises
    ------
    ValueError
        If a pattern matches nothing.
    """
    found: set[int] = set()
    for pattern in patterns:
        for each in sets.get(pattern, (pattern,)):
            places = [place for place, name in enumerate(names) if _fits(name, each)]
            if not places:
                raise ValueError(_unknown(names, each))
            found.update(places)
    return np.array(sorted(found), dtype=np.int64)


def _fits(name: str, pattern: str) -> bool:
    """Return whether a pattern matches a name or its node."""
    return fnmatchcase(name, pattern) or name.rpartition(".")[0] == pattern


def _unknown(names: Sequence[str], pattern: str) -> str:
    """Return what to say of a pattern that matches nothing."""
    nodes = [name.rpartition(".")[0] for name in names]
    near = difflib.get_close_matches(pattern, [*names, *nodes], 1)
    hint = f"did you mean {near[0]}?" if near else f"the first name is {names[0]}"
    return f"no degree of freedom is called {pattern!r}: {hint}"
