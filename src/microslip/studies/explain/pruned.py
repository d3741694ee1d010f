"""One thing of which a scene keeps a part, beside what there is in all."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Pruned:
    """One thing of which a scene keeps only a part."""

    what: str
    kept: int
    whole: int
    """what there is without pruning"""
    reason: str


def part(what: str, kept: int, whole: int, why: str) -> Pruned:
    """Return what is kept, and why, if not all of it."""
    return Pruned(what, kept, whole, why if kept < whole else "all are needed")
