"""What was found between two neighbouring points of a curve, before it is settled."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from hbm.continuation.correction import Correction
from hbm.continuation.segment import Segment, folds
from hbm.events.crossed import BRANCH
from hbm.forces.fourier import FourierBasis

UPRIGHT = 5e-3
"""part of the parameter in a unit tangent below which a multiplier +1 is that of a fold
beside the segment"""
NEAR = 0.4
"""share of a step within which a multiplier +1 is that of a fold in the same step"""


class Found(NamedTuple):
    """Where something happens between two points."""

    place: float
    """along the segment"""
    name: str
    point: Correction
    fourier: FourierBasis
    """the resolution with which it was located"""
    bend: float = math.nan
    """of a peak or a fold: change, along the segment, of what is zero there"""
    aside: float = 0.0
    """error of the parameter, if points between do not converge: the event is at the
    nearer end then"""
    error: Callable[[], float] = lambda: math.nan
    """of the parameter, of a change of stability"""


def found_between(
    name: str,
    segment: Segment,
    located: Correction | None,
    nearer: Correction,
    values: tuple[float, float],
    fourier: FourierBasis,
) -> Found | None:
    """Return a peak or a fold of a segment, at the ``nearer`` end if it is not located.

    None if the segment does not go on along the tangent at its first point.
    ``values``, at both ends, are those of what is zero there; ``fourier`` is the
    resolution with which it was located.
    """
    length = segment.length
    if length <= 0.0:
        return None
    bend = abs(values[1] - values[0]) / length
    if located is None:
        return _unlocated(name, segment, nearer, fourier, bend)
    return Found(segment.place(located.point), name, located, fourier, bend)


def in_order(found: Sequence[Found], segment: Segment, *, owed: bool) -> list[Found]:
    """Return the events in their order, without the branch points that are folds.

    At a fold, where the curve turns, a multiplier is +1 as well. Those of orbits that
    are resolved more finely than the curve may cross in the step behind it: one is
    ``owed`` then.
    """
    told = sorted(found, key=lambda each: each.place)
    branching = [each for each in told if each.name == BRANCH]
    if owed and branching:
        told.remove(branching[0])
    for turn in [each.place for each in told if each.name == "fold"]:
        branching = [each for each in told if each.name == BRANCH]
        nearest = min(branching, key=lambda each: abs(each.place - turn), default=None)
        if nearest is not None and abs(nearest.place - turn) < NEAR * segment.length:
            told = [each for each in told if each is not nearest]
    least = UPRIGHT * segment.scale[-1]
    return [
        each for each in told if each.name != BRANCH or abs(folds(each.point)) > least
    ]


def _unlocated(
    name: str, segment: Segment, end: Correction, fourier: FourierBasis, bend: float
) -> Found:
    """Return what lies between two points, though those between do not converge.

    It is taken for the point at one ``end``. From there the parameter changes by no
    more than it does along the segment with the steepest slope of both ends, if those
    between are not steeper.
    """
    steepest = max(abs(folds(each)) for each in (segment.before, segment.after))
    length = segment.length
    place = 0.0 if end is segment.before else length
    return Found(place, name, end, fourier, bend, steepest * length)
