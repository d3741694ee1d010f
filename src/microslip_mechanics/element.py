"""Elements: a law between named degrees of freedom, and the contacts they make."""

from __future__ import annotations

import inspect
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import PointLaw, contact_table
from microslip_mechanics.laws.row import Direction, Law, Row
from microslip_mechanics.structures.forms import Pair, is_name, relative

KEYS = ("between", "normal", "tangents", "rotations")
"""by which an element says in what directions its law acts"""


@dataclass(frozen=True)
class Element:
    """A law and where it acts; each direction is a pair of ends.

    An end is a degree of freedom, a table of factors of several, or ``"ground"``, which
    must be written. The law sees the motion of the first end relative to the second.
    """

    law: Law
    between: Pair | None = None
    """of laws along one direction"""
    normal: Pair | None = None
    """of contacts: positive in penetration"""
    tangents: Sequence[Pair] = ()
    """of friction: one or two"""
    rotations: Sequence[Pair] = ()
    """of area contacts: one or two"""
    name: str = ""

    def __post_init__(self) -> None:
        """Check that the law is one, and the name a text."""
        if self.name not in ("", None) and not is_name(self.name):
            raise ValueError(f"Element: name = {self.name!r}: give a text of one line")
        if isinstance(self.law, type):
            kind = self.law.__name__
            keys = ", ".join(
                f"{key}=…" for key in inspect.signature(self.law).parameters
            )
            raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
                f"Element: {kind} is a class: give {kind}({keys})"
            )
        if not (hasattr(self.law, "rows") and hasattr(self.law, "takes")):
            raise ValueError(
                f"Element: law = {self.law!r}: give a law with its numbers, such as "
                "microslip.CubicSpring(cubic=2e6)"
            )

    def directions(self) -> dict[str, Sequence[Pair]]:
        """Return the pairs that are given, by key."""
        given: dict[str, Sequence[Pair]] = {}
        if self.between is not None:
            given["between"] = (self.between,)
        if self.normal is not None:
            given["normal"] = (self.normal,)
        for key in KEYS[2:]:
            if getattr(self, key):
                given[key] = getattr(self, key)
        return given


def interface_of(elements: Iterable[Element], names: tuple[str, ...]) -> Interface:
    """Return the contacts of elements; ``names`` are those of the degrees of freedom.

    Raises
    ------
    ValueError
        With the element, its key and a remedy.
    """
    if isinstance(elements, (Element, str)) or not isinstance(elements, Iterable):
        raise ValueError(  # noqa: TRY004  (as above)
            f"elements = {elements!r}: give a list of microslip.Element"
        )
    elements = tuple(elements)
    for place, each in enumerate(elements, start=1):
        if not isinstance(each, Element):
            raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
                f"element {place} is {each!r}: give microslip.Element(law, between=…)"
            )
    laws: list[PointLaw] = []
    lines: list[Array] = []
    points: list[str] = []
    taken: set[str] = set()
    for place, (element, name) in enumerate(
        zip(elements, _named(elements), strict=True)
    ):
        rows, directions = _resolved(element, name, names)
        own = [name]
        if len(rows) > 1:
            own = [f"{name}-{number}" for number in range(1, len(rows) + 1)]
        if taken.intersection([name, *own]):
            raise ValueError(
                f"two elements are named {name}: name element {place + 1} differently"
            )
        taken.update([name, *own])
        points.extend(own)
        for row in rows:
            laws.append(row.point)
            lines.extend(_lines(row, directions, len(names)))
    shown = np.array(lines).reshape(-1, len(names))
    return Interface(contact_table(laws), shown, tuple(points))


def _named(elements: Sequence[Element]) -> list[str]:
    """Return a name of each element."""
    return [each.name or f"element-{n}" for n, each in enumerate(elements, start=1)]


def _resolved(
    element: Element, name: str, names: tuple[str, ...]
) -> tuple[tuple[Row, ...], dict[Direction, Array]]:
    """Return an element's rows and its directions over the degrees of freedom."""
    given = element.directions()
    counts = {key: len(pairs) for key, pairs in given.items()}
    for key in KEYS:
        _check_count(element, name, key, counts.get(key, 0))
    directions = {
        (key, place): relative(pair, names, f"element {name}: {_numbered(key, place)}")
        for key, pairs in given.items()
        for place, pair in enumerate(pairs)
    }
    for key in KEYS[2:]:
        if counts.get(key, 0) > 1:
            _check_apart(directions[key, 0], directions[key, 1], f"{name}: {key}")
    return element.law.rows(counts), directions


def _check_apart(one: Array, other: Array, what: str) -> None:
    """Check that two tangents, or two rotations, are not one motion.

    That would be twice as stiff as it says, and slip at √2 of its limit.
    """
    if np.array_equal(one, other) or np.array_equal(one, -other):
        raise ValueError(
            f"element {what} are the same motion twice: give it once, or two that "
            "differ"
        )


def _numbered(key: str, place: int) -> str:
    return f"{key}[{place}]" if key in KEYS[2:] else key


def _check_count(element: Element, name: str, key: str, count: int) -> None:
    """Check that the law takes so many directions of a key."""
    if key not in element.law.takes:
        if count:
            takes = ", ".join(element.law.takes)
            raise ValueError(
                f"element {name}: {key} is nothing that {_kind(element.law)} takes "
                f"here: give {takes}"
            )
        return
    least, most = element.law.takes[key]
    if not least <= count <= most:
        wanted = f"{least}" if least == most else f"{least} or {most}"
        raise ValueError(
            f"element {name}: {key} has {count} directions: {_kind(element.law)} needs "
            f'{wanted}, each with two ends; the ground is written as "ground"'
        )


def _kind(law: Law) -> str:
    """Return what a law is called, in scene files too."""
    from microslip_mechanics.laws.catalogue import LAWS  # all laws, for an error

    names = [f' (law = "{name}")' for name, made in LAWS.items() if made is type(law)]
    return type(law).__name__ + "".join(names)


def _lines(row: Row, directions: dict[Direction, Array], dofs: int) -> list[Array]:
    """Return the three rows of a point: normal and two tangents."""
    uses = (row.normal, *row.tangents, None, None)[:3]
    return [np.zeros(dofs) if use is None else directions[use] for use in uses]
