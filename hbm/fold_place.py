"""Where a fold is as it is reported, which may be aside of where it was located (§6).

More harmonics move a fold along its curve, along which the parameter hardly changes but
the amplitude does.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

from hbm.adaptive import AdaptiveBalance
from hbm.newton import Correction
from hbm.resolution_choice import MARKED
from hbm.segment import PRECISION, Segment, folds

NEAR = 1e-4
"""part of a step by which a reported fold may be aside"""
FARTHEST = 0.5
"""of a step, by which a fold that is aside is the same fold"""
MOVES = 3
"""times that it is looked for along its curve"""


class FoldPlace(NamedTuple):
    """A fold, settled where its curve folds as it is reported."""

    settled: Correction
    moved: float = 0.0
    """arc from where it was located"""
    left: float = 0.0
    """arc by which it is aside still"""


def fold_place(
    system: AdaptiveBalance,
    segment: Segment,
    settled: Correction,
    bend: float,
    settle: Callable[[Correction], Correction | None],
) -> FoldPlace:
    """Return a fold moved along its curve to where that folds as it is reported.

    It stays where nothing is corrected, where it has so many harmonics that it is
    reported as it was settled, and where the corrected curve is not found beside it.

    Parameters
    ----------
    system
        At the resolution with which the fold was settled.
    segment
        The step in which it was found.
    settled
        The fold as it was located and settled.
    bend
        Change of :func:`~hbm.segment.folds` along the segment, with its sign.
    settle
        Settles another point of the curve as a fold; None if that fails.
    """
    best = FoldPlace(settled)
    known = _slope(system, segment, settled)
    if known is None or segment.after.turns:
        return best
    place, slope = 0.0, bend
    for _ in range(MOVES):
        step = -known / slope
        best = FoldPlace(best.settled, place, abs(step))
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
        best = FoldPlace(again, place, abs(known / slope))
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
    back, system.fourier = system.fourier, fourier
    at = segment.across(point, PRECISION * segment.length)
    system.fourier = back
    return folds(at) if at else None
