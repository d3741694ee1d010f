"""One cell of the stress matrix, and rows of them."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Case:
    """One cell of the matrix."""

    parameter: str
    """its row"""
    value: str
    """what stands in the cell"""
    overrides: tuple[str, ...]
    """as ``--set`` takes them"""
    scene: str | None = None
    """a built-in one instead of the scene that is put under stress"""
    refusals: tuple[tuple[str, ...], ...] = ()
    """overrides of which each must be refused, or computed to a finite end"""


def row(
    name: str,
    values: Iterable[float],
    *templates: str,
    own: float | None = None,
    scene: str | None = None,
) -> list[Case]:
    """Return the cases of one row; a template holds ``{}`` where the value goes.

    The scene's ``own`` value is left out: it is a case of its own.
    """
    return [
        Case(
            name,
            f"{value:g}",
            tuple(each.format(repr(value)) for each in templates),
            scene,
        )
        for value in values
        if value != own
    ]
