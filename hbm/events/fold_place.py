"""Where a fold is as it is reported, which may be aside of where it was located (§6.4).

More harmonics move a fold along its curve, along which the parameter hardly changes but
the amplitude does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

from hbm.continuation.correction import Correction
from hbm.continuation.segment import PRECISION, Segment, folds
from hbm.events.amplitude_growth import AmplitudeGrowth
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.resolution.resolution_choice import MARKED
from microslip_mechanics.arrays import TINY

NEAR = 1e-4
"""part of a step by which a reported fold may be aside"""
FARTHEST = 0.5
"""of a step, by which a fold that is aside is the same fold"""
MOVES = 3
"""times that it is looked for along its curve"""


class _Place(NamedTuple):
    """A fold, settled where its curve folds as it is reported."""

    settled: Correction
    moved: float = 0.0
    """arc from where it was located"""
    left: float = 0.0
    """arc by which it is aside still"""


def placed_fold(
    system: AdaptiveBalance,
    growth: AmplitudeGrowth,
    segment: Segment,
    settled: Correction,
    settle: Callable[[Correction], Correction | None],
) -> tuple[Correction, float]:
    """Return a fold where it is reported to be, and what its amplitude may err by.

    The latter, relative, is what the amplitude changes along the curve to where the
    fold is; of what harmonics have moved it more of them move it as much less as they
    change its amplitude less.

    Parameters
    ----------
    system
        At the resolution with which the fold was settled.
    growth
        Of the largest amplitude along the curve.
    segment
        The step in which it was found.
    settled
        The fold as it was located and settled.
    settle
        Settles another point of the curve as a fold; None if that fails.
    """
    slopes = folds(segment.before), folds(segment.after)
    bend = (slopes[1] - slopes[0]) / segment.length if segment.length else 0.0
    if bend == 0.0:
        return settled, 0.0
    place = _place(system, segment, settled, bend, settle)
    if place.moved == place.left == 0.0:
        return place.settled, 0.0
    estimate = system.estimate
    if estimate is None:
        return place.settled, math.inf
    rest = min(1.0, estimate.error / max(estimate.change, TINY))
    point, _, _ = system.report.kept(place.settled.point)
    change = abs(growth(place.settled)) / float(growth.largest(point)[0])
    return place.settled, change * (place.left + rest * abs(place.moved))


def _place(
    system: AdaptiveBalance,
    segment: Segment,
    settled: Correction,
    bend: float,
    settle: Callable[[Correction], Correction | None],
) -> _Place:
    """Return a fold moved along its curve to where that folds as it is reported.

    It stays where nothing is corrected, where it has so many harmonics that it is
    reported as it was settled, and where the corrected curve is not found beside it.
    ``bend`` is the change of :func:`~hbm.continuation.segment.folds` along the segment,
    with its sign.
    """
    best = _Place(settled)
    known = _slope(system, segment, settled)
    if known is None or segment.after.turns:
        return best
    place, slope = 0.0, bend
    for _ in range(MOVES):
        step = -known / slope
        best = _Place(best.settled, place, abs(step))
        moves = NEAR * segment.length < abs(step) < FARTHEST * segment.length
        if not moves:
            break
        guess = settled.point + (place + step) * settled.along
        beside = segment.across(guess, PRECISION * segment.length)
        if beside is None:
            break
        again = settle(beside)
        value = _slope(system, segment, again) if again else None
        if again is None or value is None or abs(value) >= abs(known):
            kept = settle(best.settled)  # what is reported is what was settled last
            return best._replace(settled=kept or best.settled)
        slope, place, known = (value - known) / step, place + step, value
        best = _Place(again, place, abs(known / slope))
    return best


def _slope(
    system: AdaptiveBalance, segment: Segment, settled: Correction
) -> float | None:
    """Return what is zero at a fold, at the point as it is reported, if that is known.

    None as well if it is reported as it was settled.
    """
    point, fourier, _ = system.report.kept(settled.point)
    if fourier == system.settled or fourier.harmonics > MARKED:
        return None
    with system.resolved(fourier):
        at = segment.across(point, PRECISION * segment.length)
    return folds(at) if at else None
