"""What a curve is drawn against, and where its line begins anew."""

from __future__ import annotations

import dataclasses
import itertools

import numpy as np

from microslip.figures.style import LONG, literal
from microslip_mechanics.results.response import BEGINNINGS
from microslip_mechanics.results.response_curve import ResponseCurve

FREQUENCY = "excitation frequency [Hz]"


def abscissa(curve: ResponseCurve) -> np.ndarray:
    """Return the excitation frequency [Hz], or the parameter that is followed."""
    return curve.parameter if curve.along else curve.frequency / (2.0 * np.pi)


def abscissa_name(curve: ResponseCurve) -> str:
    """Return what stands below the axis."""
    return literal(curve.along) if curve.along else FREQUENCY


def by_decades(curve: ResponseCurve) -> bool:
    """Return whether a curve goes along a parameter over many decades."""
    return bool(curve.along) and over_decades(curve.parameter)


def over_decades(values: np.ndarray) -> bool:
    """Return whether values go over so many decades that their axis needs them."""
    return bool(np.nanmax(values) > LONG * np.nanmin(values) > 0.0)


def one_way(at: np.ndarray) -> list[slice]:
    """Return the parts of a line on which it goes on to one side alone.

    Parts that follow each other share the point at which the line turns; a gap ends a
    part. What is filled along a line that turns would be counted twice, or not at all.
    """
    ways = np.sign(np.diff(at))
    turns = [
        place
        for place, (before, after) in enumerate(itertools.pairwise(ways), start=1)
        if before != after
    ]
    ends = [0, *turns, len(at) - 1]
    return [
        slice(first, last + 1)
        for first, last in itertools.pairwise(ends)
        if np.isfinite(at[first : last + 1]).all()
    ]


def parted(curve: ResponseCurve) -> ResponseCurve:
    """Return a curve with an empty point before each at which a line begins anew."""
    places = [i for i, name in enumerate(curve.event) if i and name in BEGINNINGS]
    if not places:
        return curve
    changed: dict[str, object] = {}
    for field in dataclasses.fields(curve):
        value = getattr(curve, field.name)
        if isinstance(value, np.ndarray):
            changed[field.name] = np.insert(value, places, np.nan, axis=0)
    for name in ("event", "outcome"):
        texts = np.insert(np.array(getattr(curve, name), dtype=object), places, "")
        changed[name] = tuple(texts)
    return dataclasses.replace(curve, **changed)  # type: ignore[arg-type]
