"""Peaks of a curve that stand out by more than their amplitudes may be wrong.

Where the resolution changes from point to point amplitudes ripple, by less than their
errors: a maximum of a ripple is no peak.
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
    """Return the points of a curve without peaks that its errors do not tell apart.

    A peak descends, on the way to a higher point to either side, by more than its error
    and that of the lowest point on that way together. Where no point is higher, or
    errors are not known, it stays.
    """
    sizes = np.array(
        [
            np.hypot(*each.seen(problem.probes.rows)[1:3]).max(initial=0.0)
            for each in points
        ]
    )
    errors = sizes * [each.error for each in points]
    kept = [
        each.event != "peak" or _descends(place, sizes, errors)
        for place, each in enumerate(points)
    ]
    return [each for each, stays in zip(points, kept, strict=True) if stays]


def _descends(place: int, sizes: Array, errors: Array) -> bool:
    """Return whether a point's amplitude falls far enough to both sides."""
    for side in (slice(place, None, -1), slice(place, None)):
        way = sizes[side]
        higher = np.flatnonzero(way > sizes[place])
        if not higher.size:
            continue
        lowest = int(way[: higher[0]].argmin())
        doubt = float(errors[place] + errors[side][lowest])
        if math.isfinite(doubt) and sizes[place] - way[lowest] <= doubt:
            return False
    return True
