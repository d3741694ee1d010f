"""Rows that a law becomes in the contact table, and the directions that they use."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, TypeAlias

from microslip_mechanics.contact.points import PointLaw

Direction: TypeAlias = tuple[str, int]
"""key of an element (between, normal, tangents, rotations), and number from 0"""
Counts: TypeAlias = dict[str, tuple[int, int]]
"""for each key that a law takes, the least and the most directions"""
ALONG: Counts = {"between": (1, 1)}
"""of laws that act along one direction"""
BETWEEN: Direction = ("between", 0)


@dataclass(frozen=True, slots=True)
class Row:
    """One row of the contact table."""

    point: PointLaw
    normal: Direction | None = None
    tangents: tuple[Direction, ...] = ()


class Law(Protocol):
    """What an element obeys."""

    @property
    def takes(self) -> Counts:
        """Directions that the element must give."""
        ...

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the rows; ``given`` are the numbers of directions of the element."""
        ...


def along(point: PointLaw) -> tuple[Row, ...]:
    """Return the row of a spring or damper along the element's direction."""
    return (Row(point, normal=BETWEEN),)
