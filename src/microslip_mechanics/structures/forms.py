"""Linear forms of a motion, by the names of degrees of freedom."""

from __future__ import annotations

import difflib
import math
import numbers
from collections.abc import Mapping, Sequence
from typing import TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array

GROUND = "ground"
"""an end that does not move; never left unsaid"""
Form: TypeAlias = str | Mapping[str, float]
"""a degree of freedom, the ground, or factors of several degrees of freedom"""
Pair: TypeAlias = Sequence[Form]
"""two ends: what counts is the motion of the first relative to the second"""


def is_name(name: object) -> bool:
    """Return whether tables and pictures can show something as a name."""
    return isinstance(name, str) and bool(name.strip()) and len(name.splitlines()) == 1


def relative(pair: Pair, names: tuple[str, ...], what: str) -> Array:
    """Return the motion of a pair's first end relative to its second, shape (dofs,).

    ``what`` begins the message of an error.

    Raises
    ------
    ValueError
        If an end is missing, unknown or empty, or if both are the same.
    """
    if not isinstance(pair, Sequence) or isinstance(pair, str) or len(pair) != 2:
        end = pair if isinstance(pair, (str, Mapping)) else names[0]
        told = str(end) if isinstance(end, Mapping) else f'"{end}"'
        raise ValueError(
            f'{what} = {pair!r}: give two ends, such as [{told}, "{GROUND}"]; '
            f'the ground is written as "{GROUND}"'
        )
    row: Array = form(pair[0], names, what) - form(pair[1], names, what)
    if not row.any():
        raise ValueError(
            f"{what} = {list(pair)}: its ends do not move relative to each other: give "
            "two different ones"
        )
    return row


def form(wanted: Form, names: tuple[str, ...], what: str) -> Array:
    """Return the row of a linear form, shape (dofs,); zero for the ground."""
    row = np.zeros(len(names))
    if wanted == GROUND:
        return row
    if isinstance(wanted, str):
        row[place_of(wanted, names, what)] = 1.0
        return row
    if not isinstance(wanted, Mapping) or not wanted:
        raise ValueError(
            f"{what}: {wanted!r} is no motion: give a degree of freedom, or a table of "
            "degrees of freedom and their factors"
        )
    for name, factor in wanted.items():
        if not _real(factor) or not math.isfinite(factor):
            raise ValueError(f"{what}: factor {factor!r} of {name} is no finite number")
        row[place_of(name, names, what)] = factor
    return row


def _real(factor: object) -> bool:
    return isinstance(factor, numbers.Real) and not isinstance(factor, bool)


def place_of(name: str, names: tuple[str, ...], what: str) -> int:
    """Return the place of a degree of freedom.

    Raises
    ------
    ValueError
        If there is none of that name.
    """
    if name in names:
        return names.index(name)
    close = difflib.get_close_matches(str(name), names, n=1)
    known = ", ".join(names[:8]) + (", …" if len(names) > 8 else "")
    hint = f"do you mean {close[0]}?" if close else f"give one of {known}"
    raise ValueError(f"{what}: there is no degree of freedom {name!r}: {hint}")
