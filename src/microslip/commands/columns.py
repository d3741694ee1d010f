"""Columns of a table that stand for probes."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

    from microslip_mechanics.arrays import Array

KEY = "KEY"
"""column of a table that has the name and values of the key that changes"""
WIDTH = 10
SHOWN = 3
"""probes in a table"""
DIGITS = 3
"""that a column's largest number has at least"""
SAME = 1e-6
"""way between frequencies, relative, up to which it may be rounding"""
NOTHING = 1e-15
"""largest number of a column, in its unit, that rounding makes of zero"""


def keyed(columns: Sequence[str], key: str) -> list[str]:
    """Return the columns of a table in which a key changes."""
    return [key if name == KEY else name for name in columns]


def tabled(names: Sequence[str], sizes: Array) -> list[int]:
    """Return the places of the probes in a table.

    The first ones; where more than those are no relative motions, the ones of largest
    ``sizes`` among these.
    """
    places = [place for place, name in enumerate(names) if "-to-" not in name]
    if len(places) <= SHOWN:
        return list(range(min(len(names), SHOWN)))
    return sorted(sorted(places, key=lambda place: -sizes[place])[:SHOWN])


def headed(names: Sequence[str]) -> str:
    """Return the heads of probes' columns, in ten characters each."""
    ends = [name.split("-")[-1] for name in names]
    heads = [
        name
        if len(name) <= WIDTH
        else end
        if ends.count(end) == 1
        else name.split("-")[0]
        for name, end in zip(names, ends, strict=True)
    ]
    return " ".join(f"{head[:WIDTH]:>{WIDTH}}" for head in heads)


def titled(text: str, names: Sequence[str], of: int) -> str:
    """Return a title as wide as the columns of probes, which may not be all ``of``."""
    if of > len(names):
        text += f", {len(names)} of {of}"
    return f"{text:<{(WIDTH + 1) * len(names) - 1}}"


def decimal(
    value: float | np.floating[Any],
    largest: float | np.floating[Any],
    decimals: int,
    width: int = WIDTH,
) -> str:
    """Return a number in a column, whose largest is ``largest``, right aligned.

    It has so many decimals, unless they would leave less than :data:`DIGITS` digits of
    the largest, or more than the column is wide: then powers of ten.
    """
    most = abs(float(largest))
    few = NOTHING < most < 10.0 ** (DIGITS - 1 - decimals)
    if few or most >= 10.0 ** (width - decimals - 1):
        return f"{value:{width}.{DIGITS}e}"
    return f"{value:z{width}.{decimals}f}"


def even(values: Sequence[float], decimals: int, width: int) -> list[str]:
    """Return the numbers of a column that may span decades, in one notation.

    All have powers of ten if one of them needs it; see :func:`decimal`.
    """
    texts = [decimal(each, each, decimals, width) for each in values]
    if any("e" in text for text in texts):
        return [f"{each:{width}.{DIGITS}e}" for each in values]
    return texts


def hertz(
    value: float | np.floating[Any], seen: Sequence[float] | Array, decimals: int = 4
) -> str:
    """Return a frequency [Hz] with decimals that tell apart those that are ``seen``.

    It has so many ``decimals`` at least, or fewer where they part 100 kHz and more;
    what rounding alone parts is not told apart.
    """
    most = max((abs(float(each)) for each in seen), default=0.0) or 1.0
    width = float(max(seen) - min(seen)) if len(seen) else 0.0
    finest = most if width <= SAME * most else min(most, width)
    place = math.floor(math.log10(finest))
    return f"{value:.{max(0, decimals + max(0, -1 - place) - max(0, place - 4))}f}"


def span(counts: Iterable[float], what: str) -> str:
    """Return the least and the largest number of something, or the one that there is.

    ``what`` is one of it, such as ``harmonic``.
    """
    known = sorted({int(each) for each in counts})
    ends = f"{known[0]} to {known[-1]}" if len(known) > 1 else str(known[0])
    return f"{ends} {what}{'' if ends == '1' else 's'}"


def about(error: float, unit: str = "") -> str:
    """Return the error of a number, to stand behind it; nothing if it is not known."""
    return f" ± {error:.1g}{unit}" if math.isfinite(error) else ""


def force(*, pulls: bool) -> str:
    """Return what forces are called; those of springs and dampers pull, too."""
    return "force" if pulls else "normal force"
