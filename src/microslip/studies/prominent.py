"""Peaks and folds of a curve that stand out by more than they may be wrong.

Where the resolution changes from point to point a curve ripples, by less than its
errors: a maximum of the amplitude, or a way back of the frequency, that is a ripple is
no event.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import replace

import numpy as np

from microslip.studies.branching import branching
from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import BEGINNINGS, PeriodicResponse


def prominent(
    problem: Problem, points: Sequence[PeriodicResponse]
) -> list[PeriodicResponse]:
    """Return the points of a curve without what its errors do not tell from ripples.

    The amplitude descends from a peak, on the way to a higher point to either side, by
    more than its error and that of the lowest point on that way together; so does the
    parameter from a fold at which it is largest, and upside down; a point that is
    farther by less than the fold errs is no higher one. Where no point is higher, or
    the error of an event is not known, it stays. What leads to where a fold may be and
    away from there on one side has a fold there, else none or two. A fold may lie aside
    by as much as a point beside it is beyond, with the amplitude of that; a branch
    point that may be the fold next to it is no other event, as where its multiplier is
    all that crosses for the fold. Where more harmonics take a curve up a step back,
    without a fold, it goes on from where it passes the peak again. What does not hang
    together is looked at piece by piece.
    """
    begins = [at for at, each in enumerate(points) if each.event in BEGINNINGS]
    bounds = sorted({0, *begins, len(points)})
    return [
        each
        for first, last in itertools.pairwise(bounds)
        for each in _standing_out(
            problem, branching(problem, _wide(problem, points[first:last]))
        )
    ]


def _wide(
    problem: Problem, piece: Sequence[PeriodicResponse]
) -> list[PeriodicResponse]:
    """Return a piece whose folds may lie where points beside them are."""
    rows = problem.probes.rows
    place = np.array([each.parameter for each in piece])
    wide = list(piece)
    for at, each in enumerate(piece):
        if each.event == "fold":
            outwards = _outwards(at, place) * place
            farthest = max(_beside(at, place), key=outwards.item, default=at)
            beyond = float(outwards[farthest] - outwards[at])
            if beyond > each.parameter_error:  # unknown, it stays so
                size, other = (made.largest(rows) for made in (each, piece[farthest]))
                error = max(each.error, abs(other - size) / max(size, TINY))
                wide[at] = replace(each, parameter_error=beyond, error=error)
    return wide


def _standing_out(
    problem: Problem, piece: Sequence[PeriodicResponse]
) -> Iterator[PeriodicResponse]:
    """Yield the points of a piece without peaks and folds that may be ripples."""
    rows = problem.probes.rows
    amplitude = np.array([each.largest(rows) for each in piece])
    errors = np.array([each.error for each in piece])
    doubt = np.where(amplitude > 0.0, errors, 0.0) * amplitude
    place = np.array([each.parameter for each in piece])
    folds = np.array([each.event == "fold" for each in piece], dtype=bool)
    aside = np.where(folds, [each.parameter_error for each in piece], np.nan)
    ripples = []
    for at, each in enumerate(piece):
        if each.event == "peak":
            on = [*range(at + 1), *range(_passed(at, place, folds), len(piece))]
            # a peak told at a point may be higher, and is no lower, than this is
            same = (place == place[at]) & (amplitude == amplitude[at])
            sure = np.where(same, doubt[same].min(), doubt)
            if not _descends(at, amplitude[on], sure[on]):
                ripples.append(at)
        if each.event == "fold" and not _turns(at, place, folds, aside):
            ripples.append(at)
    left_out = _matched(ripples, place, folds, aside)
    yield from (each for at, each in enumerate(piece) if at not in left_out)


def _turns(at: int, place: Array, folds: Array, aside: Array) -> bool:
    """Return whether the parameter goes back from a fold far enough."""
    outwards = _outwards(at, place) * place
    outwards[at] = outwards[[at, *_beside(at, place)]].max()
    rivals = folds | (outwards > outwards[at] + aside[at])
    heights = np.where(rivals, outwards, outwards.clip(max=outwards[at]))
    return _descends(at, heights, aside)


def _matched(
    ripples: Sequence[int], place: Array, folds: Array, aside: Array
) -> set[int]:
    """Return which ripples to leave out, and folds that match one of them.

    Where a curve comes to what a fold may be and leaves it on the same side, one of the
    folds there stays that is known best; where it goes through, the others are paired.
    """
    left_out = set(ripples)
    for at in ripples:
        if not folds[at] or at not in left_out:
            continue
        far = np.flatnonzero(np.abs(place - place[at]) > aside[at])
        before, after = far[far < at], far[far > at]
        if not (before.size and after.size):
            continue
        first, last = int(before[-1]), int(after[0])
        here = [each for each in range(first + 1, last) if folds[each]]
        stay = [each for each in here if each not in left_out]
        back = (place[first] - place[at]) * (place[last] - place[at]) > 0.0
        if back and len(stay) % 2 == 0:
            left_out.discard(min(set(here) & left_out, key=aside.item))
        elif not back and len(stay) % 2 == 1:
            left_out.add(max(stay, key=aside.item))
    return left_out


def _passed(at: int, place: Array, folds: Array) -> int:
    """Return the next point that is not a step back from one, without a fold."""
    before = place[:at][place[:at] != place[at]]
    onwards = math.copysign(1.0, place[at] - before[-1]) if before.size else 0.0
    for after in range(at + 1, len(place)):
        if folds[after]:
            break
        if onwards * (place[after] - place[at]) > 0.0:
            return after
    return at + 1


def _beside(at: int, place: Array) -> list[int]:
    """Return the points before and behind one."""
    return [near for near in (at - 1, at + 1) if 0 <= near < place.size]


def _outwards(at: int, place: Array) -> float:
    """Return the sign with which a parameter has a maximum at a point.

    Where it lies between the points beside it, or these turn back without it, those
    before and behind them tell.
    """
    ways = _places(place[:at][::-1]), _places(place[at + 1 :])
    before, after = (float([*way, place[at]][0]) for way in ways)
    bend = 2.0 * place[at] - before - after
    if min(map(len, ways)) > 1:
        arriving, leaving = before - ways[0][1], ways[1][1] - after
        between = (place[at] - before) * (after - place[at]) > 0.0
        if between or arriving * leaving < 0.0:
            bend = arriving - leaving
    return 1.0 if bend >= 0.0 else -1.0


def _places(way: Array) -> list[float]:
    """Return the first two places on a way; what is told at a point is at its place."""
    return [float(each) for each, _ in itertools.groupby(way)][:2]


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
