"""Where a fold is as it is reported, which may be aside of where it was located (§6.4).

More harmonics and samples move a fold along its curve, along which the parameter hardly
changes but the amplitude does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from hbm.continuation.correction import Correction
from hbm.continuation.segment import PRECISION, Segment, folds
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.resolution.resolution_choice import MARKED
from microslip_mechanics.arrays import TINY

NEAR = 1e-4
"""part of a step by which a reported fold may be aside"""
FARTHEST = 0.5
"""of a step, by which a fold that is aside is the same fold"""
MOVES = 3
"""times that it is looked for along its curve, unless it has more than :data:`MARKED`
harmonics"""
PLACES = (-1.0, -0.5, 0.0, 0.5, 1.0)
"""about a fold, over what its error leaves open, at which slopes are compared"""
ERRING = math.sqrt(70.0)
"""fourth difference of values that err by one each, independently"""


class _Place(NamedTuple):
    """A fold, settled where its curve folds as it is reported."""

    settled: Correction
    moved: float = 0.0
    """arc from where it was located"""
    left: float = 0.0
    """arc by which it is aside still"""


def placed_fold(
    system: AdaptiveBalance,
    segment: Segment,
    settled: Correction,
    settle: Callable[[Correction], Correction | None],
) -> tuple[Correction, float]:
    """Return a fold where it is reported to be, and the arc by which it may be aside.

    Of what harmonics have moved it more of them move it as much less as they change its
    amplitude less. Where errors change from place to place, as with touches between
    samples, slopes about it are not smooth, and it may lie as far away as that.

    Parameters
    ----------
    system
        At the resolution with which the fold was settled.
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
    place, estimate = _place(system, segment, settled, bend, settle), system.estimate
    if place.moved == place.left == 0.0:
        return place.settled, 0.0
    if estimate is None:
        return place.settled, math.inf
    rest = min(1.0, estimate.error / max(estimate.change, TINY))
    away = place.left + rest * abs(place.moved or place.left)
    return place.settled, max(away, _uneven(system, segment, place.settled, bend))


def _place(
    system: AdaptiveBalance,
    segment: Segment,
    settled: Correction,
    bend: float,
    settle: Callable[[Correction], Correction | None],
) -> _Place:
    """Return a fold moved along its curve to where that folds as it is reported.

    It stays where it is reported as it was settled, with many harmonics, and where the
    corrected curve is not found beside it. ``bend`` is the change of
    :func:`~hbm.continuation.segment.folds` along the segment, with its sign.
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
        if not (moves and _moves(system, best.settled)):
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


def _moves(system: AdaptiveBalance, settled: Correction) -> bool:
    """Return whether a fold is reported with more, and not many, harmonics."""
    _, fourier, _ = system.report.kept(settled.point)
    return fourier != system.settled and fourier.harmonics <= MARKED


def _slope(
    system: AdaptiveBalance, segment: Segment, settled: Correction, aside: float = 0.0
) -> float | None:
    """Return what is zero at a fold, of the finer curve near or beside it, if known.

    That is the one with the resolution of its estimate; None if that led to no point.
    ``aside`` is the arc to there.
    """
    estimate = system.estimate
    if estimate is None or math.isinf(estimate.error):
        return None
    guess = estimate.corrected + aside * settled.along
    with system.resolved(estimate.fourier):
        at = segment.across(guess, PRECISION * segment.length)
    return folds(at) if at else None


def _uneven(
    system: AdaptiveBalance, segment: Segment, settled: Correction, bend: float
) -> float:
    """Return the arc by which a fold may be aside for slopes that are not smooth.

    That is twice the deviation of slopes of the finer curve from polynomials of third
    degree, at places about the fold as far as the error of its parameter leaves open
    where the curve folds; none where a slope is not known.
    """
    reach = math.sqrt(4.0 * system.report.aside / abs(bend))
    slopes = [
        _slope(system, segment, settled, place * min(reach, abs(segment.length)))
        for place in PLACES
    ]
    known = [each for each in slopes if each is not None]
    if len(known) < len(slopes):
        return 0.0
    difference = float(np.diff(known, len(known) - 1)[0])
    return 2.0 * abs(difference) / ERRING / abs(bend)
