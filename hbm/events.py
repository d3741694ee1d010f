"""What happens between two points of a curve: peaks, folds, changes of stability.

Each is located on the curve, and settled as accurately as its points (theory §6).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from operator import attrgetter
from typing import NamedTuple

import numpy as np

from hbm.adaptive import AdaptiveBalance
from hbm.arc_step import Metric
from hbm.fourier import FourierBasis
from hbm.multipliers import Multipliers
from hbm.newton import Correction, Outcome
from hbm.resolution import PathResolution
from hbm.segment import PRECISION, ROUGH, ROUGHER, SURE, Segment, folds
from hbm.step_control import StepControl
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.response import MARGIN

LOCATING = FourierBasis(31, 256)
"""most that is taken, if the curve has no more, to locate a change of stability"""
STRICT, SHARP = 0.1, ("fold", "peak")
"""share of the error of a point that these events may have: they mark a frequency"""
LEAP = 0.1
"""of the change of a multiplier between two points: what is left of its excess where it
is located, from which on it leaps"""
UPRIGHT = 5e-3
"""part of the parameter in a unit tangent below which a multiplier +1 is that of a fold
beside the segment"""
NEAR = 0.4
"""share of a step within which a multiplier +1 is that of a fold in the same step"""
AROUND = (-0.5, 0.5, -1.5, 1.5)
"""places about a fold, over the step, at which its curve has slopes of both signs"""
FLAT = 1e-13
"""change of an amplitude, relative, that may be rounding"""
REAL = 1e-6
"""imaginary part of a multiplier, over its modulus, below which it is real"""
ASIDE = 3e-3
"""part of a step by which a peak may be aside"""
by_harmonics = attrgetter("harmonics")
TORUS, BRANCH = "Neimark-Sacker", "branch point"


class Settled(NamedTuple):
    """A settled point of a curve, with what its multipliers say and ask for."""

    correction: Correction
    multipliers: ComplexArray
    finer: FourierBasis
    """the resolution that they ask for"""
    asks: bool
    """whether that is more than the reported orbit has"""
    reported: Correction
    """the point as it is reported, where events are sought"""
    fourier: FourierBasis
    """its resolution"""
    growth: float = math.nan
    """of its largest amplitude along the curve"""


class Found(NamedTuple):
    """Where something happens between two points."""

    place: float
    """along the segment"""
    name: str
    point: Correction
    fourier: FourierBasis
    """the resolution with which it was located"""


@dataclass(frozen=True, slots=True)
class Events:
    """Finds them along a path."""

    system: AdaptiveBalance
    resolution: PathResolution
    control: StepControl
    multipliers: Multipliers
    limits: tuple[float, float]
    """of the parameter, the least first"""
    recalls: bool
    """whether a contact has a memory"""

    def between(
        self, before: Settled, after: Settled, metric: Metric
    ) -> Iterator[tuple[Correction, str]]:
        """Yield the events between two neighbouring points, in their order."""
        fourier = self.system.fourier
        self.system.fourier = self.system.settled
        segment = self._segment(before.correction, after.correction, metric)
        found = [
            *self._folded(segment),
            *self._peaks(before, after, metric),
            *self._changes(segment, before, after),
        ]
        for each in _told(found, segment):
            self.system.fourier = each.fourier
            event = self._settled(each, segment, metric)
            if event is None or (
                each.name == "fold" and not self._folds(segment, event)
            ):
                continue
            yield event, each.name
        self.system.fourier = fourier

    def directed(self, settled: Settled, metric: Metric) -> Settled:
        """Return a settled point with how its largest amplitude grows.

        The tangent where it is reported is known about; where it tells otherwise than
        that of the curve, the point is solved there.
        """
        correction, scale = settled.correction, metric(settled.correction.point)
        reported, fourier = self.system.reported(correction, scale)
        growth, solved = self.growth(reported), self.growth(correction)
        if growth * solved < 0.0:
            back, self.system.fourier = self.system.fourier, fourier
            about = self._segment(reported, reported, metric)
            reported = about.across(reported.point, PRECISION) or reported
            growth = self.growth(reported)
            self.system.fourier = back
        return settled._replace(reported=reported, fourier=fourier, growth=growth)

    def _segment(
        self, before: Correction, after: Correction, metric: Metric
    ) -> Segment:
        loose = self.control.loose if self.control.negligible else 0.0
        scale = metric(before.point)
        return Segment(self.system, before, after, scale, self.control.tolerance, loose)

    def _settled(
        self, found: Found, segment: Segment, metric: Metric
    ) -> Correction | None:
        """Return what was located as accurate as it is to be; None if it is lost."""
        located = found.point
        normal = located.along / metric(located.point) ** 2
        normal /= np.abs(normal).max()
        settled = self.system.settle(
            located,
            normal,
            self.control.tolerance,
            segment.small(PRECISION * SURE),
            share=STRICT if found.name in SHARP else 1.0,
            across=found.name == "fold",
        )
        away = (settled.point - located.point) / segment.scale
        near = float(np.linalg.norm(away)) < segment.length
        if not near or settled.outcome is not Outcome.CONVERGED:
            return None
        return replace(settled, tangent=located.tangent)

    def _peaks(
        self, before: Settled, after: Settled, metric: Metric
    ) -> Iterator[Found]:
        """Yield where the amplitude is largest.

        With the resolution of the points as they are reported, unless that of the curve
        has it at the same place: what hardly changes an amplitude may well move the
        place at which it is largest.
        """
        growth = before.growth, after.growth
        if not growth[0] > 0.0 > growth[1]:
            return
        ends, solved = (before.reported, after.reported), self.system.fourier
        settled = before.correction, after.correction
        coarse = self.growth(settled[0]), self.growth(settled[1])
        if coarse[0] > 0.0 > coarse[1] and abs(_zero(coarse) - _zero(growth)) < ASIDE:
            ends, growth = settled, coarse
        else:
            self.system.fourier = max(before.fourier, after.fourier, key=by_harmonics)
        segment = self._segment(*ends, metric)
        located = segment.locate(self.growth, growth)
        if located is not None:
            place = segment.place(located.point)
            yield Found(place, "peak", located, self.system.fourier)
        self.system.fourier = solved

    def _folded(self, segment: Segment) -> Iterator[Found]:
        """Yield where the curve folds."""
        located = segment.locate(folds)
        if located is not None:
            place = segment.place(located.point)
            yield Found(place, "fold", located, self.system.fourier)

    def _folds(self, segment: Segment, fold: Correction) -> bool:
        """Return whether the curve folds as finely resolved as its fold is told.

        That of the points makes folds of its own where it is hardly enough or changes.
        """
        point, self.system.fourier, _ = self.system.kept(fold.point)
        step = segment.length * fold.along
        near = PRECISION * segment.length
        points = [segment.across(point + share * step, near) for share in AROUND]
        slopes = [folds(each) for each in points if each]
        return None in points[:2] or min(slopes) <= 0.0 <= max(slopes)

    def _changes(
        self, segment: Segment, before: Settled, after: Settled
    ) -> Iterator[Found]:
        """Yield where multipliers cross the unit circle, and what that means."""
        paired = False
        for which in crossings(before.multipliers, after.multipliers):
            if paired:  # a conjugate crosses where the one before it does
                paired = False
                continue
            located, multiplier = self._crossing(segment, which, before, after)
            kind = crossed(multiplier)
            paired = kind == TORUS
            if located is not None:
                place = segment.place(located.point)
                yield Found(place, kind, located, self.system.fourier)

    def _crossing(
        self, segment: Segment, which: int, before: Settled, after: Settled
    ) -> tuple[Correction | None, complex]:
        """Return where a multiplier crosses the unit circle, if it does, and its value.

        The value is the one next to it that is still outside. A multiplier that leaps
        over the circle does not cross it: a slider begins to slip there, or sticks for
        good, and nothing branches.
        """
        finer, precision = self._asked(before, after)
        ends = before.multipliers[which], after.multipliers[which]
        outside = max(ends, key=abs)

        def growth(correction: Correction) -> float:
            nonlocal outside  # the bracket shrinks: the last one is the nearest
            multiplier = self._finest(correction, finer)[which]
            if excess(multiplier) > 0.0:
                outside = multiplier
            return excess(multiplier)

        first, last = map(excess, ends)
        located = segment.locate(growth, (first, last), precision)
        if self.recalls and located is not None:
            leaps = abs(growth(located)) > LEAP * abs(last - first)
            located = None if leaps else located
        return located, outside

    def _asked(
        self, before: Settled, after: Settled
    ) -> tuple[FourierBasis | None, float]:
        """Return the resolution of multipliers between two points, and a precision.

        It is that of the orbits that are reported, or what their multipliers ask for;
        none if it is that of the curve.
        """
        own = self.system.fourier
        finer = max(before.finer, after.finer, key=by_harmonics)
        samples = max(LOCATING.samples, own.samples)
        most = replace(LOCATING, samples=samples, threshold=finer.threshold)
        finer = min(finer, max(own, most, key=by_harmonics), key=by_harmonics)
        used = finer if finer.harmonics > own.harmonics else None
        return used, ROUGHER if before.asks or after.asks else ROUGH

    def growth(self, correction: Correction) -> float:
        """Return the change of the largest amplitude along the curve."""
        point, along = correction.point, correction.along
        # Without contact the frequency is all that changes.
        moved = slice(None, -1) if along[:-1].any() else slice(-1, None)
        # At rest any change does: to both sides the amplitude is the same.
        size = float(np.linalg.norm(point[moved])) or 1.0
        small = 1e-6 * size / float(np.linalg.norm(along[moved]))
        beside = point + np.outer((-small, small), along)
        beside[:, -1] = beside[:, -1].clip(*self.limits)
        sizes = self.resolution.amplitudes(list(beside))
        place = int(sizes[0].argmax())
        change = float(sizes[1][place] - sizes[0][place])
        rounding = FLAT * float(sizes[0][place])
        return change / small if abs(change) > rounding else 0.0

    def _finest(
        self, correction: Correction, finer: FourierBasis | None
    ) -> ComplexArray:
        """Return the multipliers at a point, of the orbit with a finer resolution."""
        point, fourier = correction.point, self.system.fourier
        if finer is not None:
            found = self.multipliers.finer(point, finer)
            point, fourier = (point, fourier) if found is None else (found, finer)
        return self.multipliers.at(point, fourier)


def _told(found: Sequence[Found], segment: Segment) -> list[Found]:
    """Return the events in their order, without the branch points that are folds.

    At a fold, where the curve turns, a multiplier is +1 as well.
    """
    told = sorted(found, key=lambda each: each.place)
    for turn in [each.place for each in told if each.name == "fold"]:
        branching = [each for each in told if each.name == BRANCH]
        nearest = min(branching, key=lambda each: abs(each.place - turn), default=None)
        if nearest is not None and abs(nearest.place - turn) < NEAR * segment.length:
            told = [each for each in told if each is not nearest]
    least = UPRIGHT * segment.scale[-1]
    return [
        each for each in told if each.name != BRANCH or abs(folds(each.point)) > least
    ]


def _zero(growth: tuple[float, float]) -> float:
    """Return where a growth is zero, over the step, as far as it is linear."""
    return growth[0] / (growth[0] - growth[1])


def excess(multiplier: complex) -> float:
    """Return by how much the modulus of a multiplier exceeds one."""
    return float(abs(multiplier) - 1.0 - MARGIN)


def crossings(before: ComplexArray, after: ComplexArray) -> range:
    """Return which Floquet multipliers cross the unit circle between two points.

    A multiplier is known by its place in the order of moduli, the largest first.
    """
    return range(*sorted((_outside(before), _outside(after))))


def crossed(multiplier: complex) -> str:
    """Return what happens where a multiplier is on the unit circle.

    At +1, where the curve does not fold, another branch begins; at −1 a period doubles;
    elsewhere, together with its conjugate, a torus begins.
    """
    if abs(multiplier.imag) > REAL * abs(multiplier):
        return TORUS
    return BRANCH if multiplier.real > 0.0 else "period doubling"


def _outside(multipliers: ComplexArray) -> int:
    """Return the number of multipliers outside the unit circle."""
    return int((np.abs(multipliers) > 1.0 + MARGIN).sum())
