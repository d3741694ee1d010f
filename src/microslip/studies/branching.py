"""Branch points of a curve that are not those of its folds, nor of its ripples.

At a fold a multiplier is +1 as well; where the resolution changes from point to point
it may be there a few points before the curve folds, or pass +1 to and fro.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

BRANCH, FOLD = "branch point", "fold"
NEAR = 2
"""points between a fold and a branch point that may be it, and behind a branch point
within which it comes to nothing"""


def branching(
    problem: Problem, piece: Sequence[PeriodicResponse]
) -> list[PeriodicResponse]:
    """Return points that hang together without branch points that are none.

    Those that may be the fold next to them are none, nor are those behind or before
    which stability is soon what it was, though nothing is told that changes it.
    """
    left = [
        at
        for at, each in enumerate(piece)
        if each.event != BRANCH
        or not (_undone(piece, at) or _undone(piece[::-1], len(piece) - 1 - at))
    ]
    for at, each in enumerate(piece):
        if each.event == FOLD:
            same = [other for other in left if _may_be(problem, piece, at, other)]
            if same:
                left.remove(min(same, key=lambda other: abs(other - at)))
    return [piece[at] for at in left]


def _undone(piece: Sequence[PeriodicResponse], at: int) -> bool:
    """Return whether what changes at a branch point soon changes back behind it.

    Without anything between that is told to change it.
    """
    before, passed = _outside(piece[:at][::-1]), 0
    for each in piece[at + 1 :]:
        if each.event not in ("", "peak") or passed == NEAR:
            return False
        if not each.event:
            passed += 1
            if passed > 1 and each.unstable == before >= 0:
                return True
    return False


def _may_be(
    problem: Problem, piece: Sequence[PeriodicResponse], at: int, other: int
) -> bool:
    """Return whether a point is a branch point that may be the fold at another one.

    If it is near, and no other multiplier crosses for the fold, or the parameters are
    the same but for the error; farther away, if the amplitudes are as well.
    """
    fold, beside = piece[at], piece[other]
    if beside.event != BRANCH:
        return False
    near = abs(other - at) <= NEAR
    same = abs(beside.parameter - fold.parameter) <= fold.parameter_error
    if near or not same:
        return near and (same or _uncrossed(at, piece))
    rows, doubt = problem.probes.rows, fold.error + beside.error
    sizes = [each.largest(rows) for each in (fold, beside)]
    return math.isfinite(doubt) and abs(sizes[1] - sizes[0]) <= doubt * sizes[0]


def _uncrossed(at: int, piece: Sequence[PeriodicResponse]) -> bool:
    """Return whether as many multipliers are known to be outside on both sides.

    What crosses at +1 for a fold has crossed in another step then.
    """
    before, after = _outside(piece[:at][::-1]), _outside(piece[at + 1 :])
    return before == after >= 0


def _outside(way: Iterable[PeriodicResponse]) -> int:
    """Return how many multipliers are outside at the first point; −1 if unknown."""
    return next((each.unstable for each in way if not each.event), -1)
