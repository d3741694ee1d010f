"""Peaks and folds of a curve that stand out by more than they may be wrong.

Where the resolution changes from point to point a curve ripples, by less than its
errors: a maximum of the amplitude, or a way back of the frequency, that is a ripple is
no event.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence

import numpy as np

from hbm.curves.detached import MARKS
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
    higher, or the error of an event is not known, it stays. What does not hang together
    is looked at piece by piece.
    """
    begins = [at for at, each in enumerate(points) if each.event in MARKS]
    bounds = sorted({0, *begins, len(points)})
    return [
        each
        for first, last in itertools.pairwise(bounds)
        for each in _standing_out(problem, points[first:last])
    ]


def _standing_out(
    problem: Problem, piece: Sequence[PeriodicResponse]
) -> Iterator[PeriodicResponse]:
    """Yield the points of a piece without peaks and folds that may be ripples."""
    rows = problem.probes.rows
    amplitude = np.array([each.amplitudes(rows).max(initial=0.0) for each in piece])
    errors = np.array([each.error for each in piece])
    doubt = np.where(amplitude > 0.0, errors, 0.0) * amplitude
    place = np.array([each.parameter for each in piece])
    aside = np.array([each.parameter_error for each in piece])
    for at, each in enumerate(piece):
        if each.event == "peak" and not _descends(at, amplitude, doubt):
            continue
        outwards = _outwards(at, place) * place
        if each.event == "fold" and not _descends(at, outwards, aside):
            continue
        yield each


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
