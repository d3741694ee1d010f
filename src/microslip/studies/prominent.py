"""Peaks and folds of a curve that stand out by more than they may be wrong.

Where the resolution changes from point to point a curve ripples, by less than its
errors: a maximum of the amplitude, or a way back of the frequency, that is a ripple is
no event.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse


def prominent(
    problem: Problem, points: Sequence[PeriodicResponse]
) -> list[PeriodicResponse]:
    """Return the points of a curve without what its errors do not tell from ripples.

    The amplitude descends from a peak, on the way to a higher point to either side, by
    more than its error and that of the lowest point on that way together; so does the
    parameter from a fold at which it is largest, and upside down. Where no point is
    higher, or the error of an event is not known, it stays.
    """
    if not any(each.event in ("peak", "fold") for each in points):
        return list(points)
    amplitude = _amplitude(problem, points)
    moves = amplitude > 0.0
    errors = np.array([each.error for each in points])
    doubt = np.multiply(amplitude, errors, out=np.zeros(len(points)), where=moves)
    place = np.array([each.parameter for each in points])
    aside = np.array([each.parameter_error for each in points])

    def stands_out(at: int, event: str) -> bool:
        if event == "peak":
            return _descends(at, amplitude, doubt)
        if event == "fold":
            return _descends(at, _outwards(at, place) * place, aside)
        return True

    return [each for at, each in enumerate(points) if stands_out(at, each.event)]


def _amplitude(problem: Problem, points: Sequence[PeriodicResponse]) -> Array:
    """Return the largest first harmonic of a probe at each point [m], (points,)."""
    rows = problem.probes.rows
    firsts = [each.seen(rows)[1:3] for each in points]
    return np.array([np.hypot(*each).max(initial=0.0) for each in firsts])


def _outwards(at: int, place: Array) -> float:
    """Return the sign with which a parameter has a maximum at a point."""
    before, after = place[max(at - 1, 0)], place[min(at + 1, len(place) - 1)]
    return 1.0 if 2.0 * place[at] >= before + after else -1.0


def _descends(at: int, heights: Array, doubts: Array) -> bool:
    """Return whether heights fall far enough on both sides of a point."""
    if not math.isfinite(doubts[at]):
        return True
    for side in (slice(at, None, -1), slice(at, None)):
        way = heights[side]
        higher = np.flatnonzero(way > heights[at])
        if not higher.size:
            continue
        lowest = int(way[: higher[0]].argmin())
        other = np.nan_to_num(doubts[side][lowest], posinf=0.0)
        if heights[at] - way[lowest] <= doubts[at] + other:
            return False
    return True
