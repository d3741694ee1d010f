"""How far from its true place on a curve a peak or a fold may lie (theory §6.4)."""

from __future__ import annotations

import math
from typing import NamedTuple

from hbm.continuation.arc import distance
from hbm.continuation.correction import Correction
from hbm.continuation.segment import PRECISION, Segment, folds
from hbm.events.amplitude_growth import AmplitudeGrowth
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

AROUND = (0.5, 1.5)
"""distances from a fold, over the step, to whose sides its curve has slopes of both
signs: the second if not the first, …"""
NEARER = 0.1
"""… or so little, if another fold is as near as that"""
CLOSER = (1.0, 0.5, 0.25)
"""of such a distance, where the plane across the curve meets another part of it"""
FLATTER = 0.75
"""of the steepest slope about a fold, that the nearest to it has at the most"""
FARTHER, WIDEST = 10.0, 1e-2
"""… or so many times more each, up to this arc: steps are short at corners, which lie
elsewhere where they are resolved more finely"""


class FoldError(NamedTuple):
    """How far aside a fold may be."""

    parameter: float
    """by its parameter"""
    arc: float = 0.0
    """along the curve, where it was found farther away than the step tells"""
    within: float = math.inf
    """arc about which the curve has slopes of both signs, or is lost"""


def fold_error(
    system: AdaptiveBalance, segment: Segment, fold: Correction, bend: float
) -> FoldError | None:
    """Return the error of a fold; None if the curve does not fold there.

    That of the points makes folds of its own where its resolution is hardly enough or
    changes: what counts is the one with which the fold is reported. To the error of
    that point comes as much as the curve goes on to there, where it is not yet upright.

    Parameters
    ----------
    system
        Of the curve, which settled the fold last.
    segment
        The step in which the fold was found.
    fold
        As it was settled last.
    bend
        Change of :func:`~hbm.continuation.segment.folds` along the segment.
    """
    error = system.report.aside
    point, fourier, _ = system.report.kept(fold.point)
    step, near = segment.length * fold.along, PRECISION * segment.length
    if segment.after.turns:
        length = abs(segment.length)
        return FoldError(error + abs(folds(fold)) * length, length, length)
    with system.resolved(fourier):
        at = segment.across(point, near)
        doubt = _turns(segment, at.point if at else point, step, near)
        if doubt is None:
            return None
    if at is None:
        return FoldError(math.inf)
    slope = folds(at)
    return doubt._replace(parameter=error + doubt.parameter + slope**2 / bend)


def _turns(
    segment: Segment, point: Array, step: Array, near: float
) -> FoldError | None:
    """Return what a fold may be aside if a curve has slopes of both signs about it.

    None if it has not; nothing where the curve is lost. Where it is lost to one side
    alone, towards which it becomes upright, it may have turned before that.
    """
    slopes: dict[float, float] = {}
    lost = 0.0
    for away in _distances(segment.length):
        for place in (-away, away):
            slope = _slope(segment, point, place * step, near)
            if slope is not None:
                slopes[place] = slope
            elif slopes.keys() <= {-away}:
                return FoldError(0.0)
            else:
                lost = lost or place
        if min(slopes.values()) <= 0.0 <= max(slopes.values()):
            arc = away * segment.length
            far = away > AROUND[-1]
            return _doubt(slopes, arc) if far else FoldError(0.0, within=arc)
    nearer = [_slope(segment, point, place * step, near) for place in (-NEARER, NEARER)]
    known = [each for each in nearer if each is not None]
    if len(known) == len(nearer) and min(known) < 0.0 < max(known):
        return FoldError(0.0, within=NEARER * segment.length)
    upright = bool(lost) and _flattens(slopes, lost)
    return _doubt(slopes, abs(lost) * segment.length) if upright else None


def _slope(segment: Segment, fold: Array, aside: Array, near: float) -> float | None:
    """Return the slope of the curve beside a fold; None where the curve is lost.

    What lies farther from a guess than that from the fold is another part of the curve,
    which the plane across meets too: the nearer the fold, the less.
    """
    for closer in CLOSER:
        guess = fold + closer * aside
        at = segment.across(guess, near)
        if at is None:
            return None
        away = distance(guess, fold, segment.scale)
        if distance(at.point, guess, segment.scale) < away:
            return folds(at)
    return None


def _doubt(slopes: dict[float, float], arc: float) -> FoldError:
    """Return what a fold may be aside along an arc with such slopes."""
    return FoldError(_steepest(slopes) * arc, arc, arc)


def _steepest(slopes: dict[float, float]) -> float:
    return max(map(abs, slopes.values()))


def _flattens(slopes: dict[float, float], lost: float) -> bool:
    """Return whether slopes at places become small towards one where none is known."""
    nearest = max(slopes, key=lambda place: place * lost)
    return abs(slopes[nearest]) <= FLATTER * _steepest(slopes)


def _distances(length: float) -> list[float]:
    """Return how far from a fold its curve is looked at, over the step."""
    found = list(AROUND)
    while FARTHER * found[-1] * length <= WIDEST:
        found.append(FARTHER * found[-1])
    return found


def peak_error(
    system: AdaptiveBalance,
    growth: AmplitudeGrowth,
    segment: Segment,
    peak: Correction,
    bend: float,
) -> tuple[float, float]:
    """Return the error of a peak's parameter, and what its amplitude errs by for it.

    The parameter errs as far as errors of amplitudes leave open which is the largest,
    and as far as it lies elsewhere where it is resolved more finely. The latter costs
    amplitude too, relative.

    Parameters
    ----------
    system
        Of the curve.
    growth
        Of the largest amplitude along the curve.
    segment
        The step in which the peak was found.
    peak
        As it was settled last.
    bend
        Change of the growth along the segment.
    """
    point, _, error = system.report.kept(peak.point)
    largest = float(growth.largest(point)[0])
    doubt = math.sqrt(4.0 * error * largest / bend)
    finer, fourier = system.report.reported(peak, segment.scale)
    if fourier != system.settled:  # its tangent is roughly known
        with system.resolved(fourier):
            near = PRECISION * segment.length
            finer = segment.across(finer.point, near) or finer
    steep = abs(growth(finer))
    aside = 0.5 * steep**2 / bend / largest
    return (doubt + steep / bend) * abs(folds(peak)), aside
