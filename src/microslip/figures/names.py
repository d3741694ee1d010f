"""Which probes and contacts a picture shows, and what it calls them."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable, Sequence

import numpy as np

from microslip.figures.style import literal
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response_curve import pulling

LETTERS = 40
"""in a line of a legend"""
RESTS = 1e-9
"""of the largest motion, below which another one is nothing but rounding errors"""


def absolute(probes: Iterable[str]) -> list[int]:
    """Return the places of the probes that are no relative motion."""
    return [place for place, name in enumerate(probes) if "-to-" not in name]


def foremost(probes: Sequence[str], sizes: Array) -> list[int]:
    """Return the places of the motions that have panels of their own, in their order.

    Beside relative motions, which have theirs too, they are the first two, else the
    three of largest swings, the ``sizes``, shape (probes,). What rests has none beside
    them.
    """
    places = absolute(probes)
    least = RESTS * max((float(sizes[place]) for place in places), default=0.0)
    places = [place for place in places if sizes[place] >= least]
    if relative(probes):
        return places[:2]
    return sorted(sorted(places, key=lambda place: -sizes[place])[:3])


def swings(motions: Sequence[Array]) -> Array:
    """Return how far each probe swings [m], of motions (rows, probes) each."""
    every = np.concatenate(motions)
    return np.ptp(every, axis=0) if len(every) else np.zeros(every.shape[1])


def relative(probes: Iterable[str]) -> list[int]:
    """Return the places of the probes that are relative motions, "this-to-that"."""
    return [place for place, name in enumerate(probes) if "-to-" in name]


def faces(contacts: Iterable[str]) -> dict[str, list[int]]:
    """Return the places of the contact points of each face, "B1" being on face B."""
    found: dict[str, list[int]] = {}
    for place, name in enumerate(contacts):
        found.setdefault(name.rstrip("0123456789").rstrip("-"), []).append(place)
    return found


def called(face: str, contacts: Sequence[str]) -> str:
    """Return what titles call the points of a face, or of the element of that name."""
    if len(face) == 1:
        return f"face {face}"
    name = contacts[0] if len(contacts) == 1 else face
    return literal(name if name.startswith("element") else f"element {name}")


def force_kind(smallest: Array, largest: Array) -> str:
    """Return what titles call forces between these [N]; those of contacts push."""
    return "Forces" if pulling(smallest, largest) else "Normal forces"


def readable(name: str) -> str:
    """Return a probe's name as words."""
    return literal(name.replace("-", " "))


def listed(*names: str) -> str:
    """Return what a legend, which leaves out what begins with "_", calls contacts."""
    return _seen(literal(", ".join(names)))


def listed_motion(name: str) -> str:
    """Return what a legend calls a probe."""
    return _seen(readable(name))


def _seen(label: str) -> str:
    """Return a label that legends do not leave out, in lines of a legend's width."""
    label = textwrap.fill(label, LETTERS)
    return f" {label}" if label.startswith("_") else label
