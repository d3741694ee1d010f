"""What happens between two points of a curve: peaks, folds, changes of stability.

Each is located on the curve, and settled as accurately as its points (theory §6.4).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from hbm.continuation.arc import Metric, distance, plane_across
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.segment import PRECISION, SURE, Segment, folds
from hbm.continuation.step_control import StepControl
from hbm.events.amplitude_growth import AmplitudeGrowth
from hbm.events.crossings import Crossings
from hbm.events.event_error import fold_error, peak_error
from hbm.events.fold_place import placed_fold
from hbm.events.found import Found, found_between, in_order
from hbm.events.multipliers import Multipliers
from hbm.events.settled import Settled
from hbm.forces.fourier import by_harmonics
from hbm.resolution.adaptive import AdaptiveBalance

STRICT, SHARP = 0.1, ("fold", "peak")
"""share of the error of a point that these events may have: they mark a frequency"""
ASIDE = 3e-3
"""part of a step by which a peak may be aside"""


class Event(NamedTuple):
    """A settled event of a curve."""

    correction: Correction
    name: str
    error: float
    """of the parameter where it lies; NaN if nothing is known of it"""
    aside: float = 0.0
    """error of the amplitude, relative, as the event may lie aside on its curve"""


@dataclass(frozen=True, slots=True)
class Events:
    """Finds them along a path."""

    system: AdaptiveBalance
    growth: AmplitudeGrowth
    control: StepControl
    multipliers: Multipliers
    recalls: bool
    """whether a contact has a memory"""

    def between(
        self, before: Settled, after: Settled, metric: Metric
    ) -> Iterator[Event]:
        """Yield the events between two neighbouring points, in their order."""
        segment = self._segment(before.correction, after.correction, metric)
        with self.system.resolved(self.system.settled):
            some = self._fold(segment, before), self._peak(before, after, metric)
            found = [each for each in some if each is not None]
            found += self._changes(segment, before, after)
            for each in in_order(found, segment, owed=before.owes):
                self.system.fourier = each.fourier
                settled = self._settled(each, segment, metric)
                if settled is None and each.name == "fold" and segment.after.turns:
                    each, settled = self._before_corner(each, segment, metric)
                if settled is None:
                    continue
                told = self._told(each, settled, segment, metric)
                if told is not None:
                    yield told

    def directed(self, settled: Settled, metric: Metric) -> Settled:
        """Return a settled point with how its largest amplitude grows.

        The tangent where it is reported is known about; where it tells otherwise than
        that of the curve, the point is solved there.
        """
        correction, scale = settled.correction, metric(settled.correction.point)
        reported, fourier = self.system.report.reported(correction, scale)
        growth, solved = self.growth(reported), self.growth(correction)
        if growth * solved < 0.0:
            with self.system.resolved(fourier):
                about = self._segment(reported, reported, metric)
                reported = about.across(reported.point, PRECISION) or reported
            growth = self.growth(reported)
        return settled._replace(reported=reported, fourier=fourier, growth=growth)

    def _segment(
        self, before: Correction, after: Correction, metric: Metric
    ) -> Segment:
        loose = self.control.loose if self.control.negligible else 0.0
        scale = metric(before.point)
        return Segment(self.system, before, after, scale, self.control.tolerance, loose)

    def _settled(
        self, found: Found, segment: Segment, metric: Metric, *, across: bool = True
    ) -> Correction | None:
        """Return what was located as accurate as it is to be; None if it is lost.

        ``across`` is whether the error of a fold is that across the curve.
        """
        located = found.point
        settled = self.system.settle(
            located,
            plane_across(located.along, metric(located.point)),
            self.control.tolerance,
            segment.small(PRECISION * SURE),
            share=STRICT if found.name in SHARP and not segment.after.turns else 1.0,
            across=across and found.name == "fold",
        )
        away = distance(settled.point, located.point, segment.scale)
        if not away < abs(segment.length) or settled.outcome is not Outcome.CONVERGED:
            return None
        return replace(settled, tangent=located.tangent)

    def _before_corner(
        self, found: Found, segment: Segment, metric: Metric
    ) -> tuple[Found, Correction | None]:
        """Return a fold at a corner as the curve came there, and as it is settled.

        More harmonics turn before it, and have no point like that: it errs by what the
        parameter changes round the corner.
        """
        self.system.fourier = found.fourier
        moved = float(segment.after.point[-1] - segment.before.point[-1])
        found = found._replace(aside=abs(moved))
        return found, self._settled(found, segment, metric, across=False)

    def _placed(
        self, found: Found, settled: Correction, segment: Segment, metric: Metric
    ) -> tuple[Correction, float]:
        """Return a fold where it is reported to be, and how far aside it may be."""

        def settle(beside: Correction) -> Correction | None:
            return self._settled(found._replace(point=beside), segment, metric)

        return placed_fold(self.system, segment, settled, settle)

    def _peak(self, before: Settled, after: Settled, metric: Metric) -> Found | None:
        """Return where the amplitude is largest.

        With the resolution of the points as they are reported, unless that of the curve
        has it at the same place: what hardly changes an amplitude may well move the
        place at which it is largest.
        """
        growth = before.growth, after.growth
        if not growth[0] > 0.0 > growth[1]:
            return None
        ends = before.reported, after.reported
        fourier = max(before.fourier, after.fourier, key=by_harmonics)
        settled = before.correction, after.correction
        coarse = self.growth(settled[0]), self.growth(settled[1])
        if coarse[0] > 0.0 > coarse[1] and abs(_zero(coarse) - _zero(growth)) < ASIDE:
            ends, growth, fourier = settled, coarse, self.system.fourier
        segment = self._segment(*ends, metric)
        with self.system.resolved(fourier):
            located = segment.locate(self.growth, growth)
        sizes = self.growth.largest(*(each.point for each in ends))
        nearer = ends[int(sizes.argmax())]
        return found_between("peak", segment, located, nearer, growth, fourier)

    def _fold(self, segment: Segment, before: Settled) -> Found | None:
        """Return where the curve folds, at a corner too.

        The point before a corner has the resolution with which the curve came there:
        with more harmonics it may turn earlier, and have no point like that.
        """
        fourier = self.system.fourier
        if segment.after.turns:
            return Found(0.0, "fold", segment.before, before.solved)
        slopes = folds(segment.before), folds(segment.after)
        if not slopes[0] * slopes[1] < 0.0:
            return None
        located = segment.locate(folds, leaps=True)
        ends = segment.before, segment.after
        nearer = max(ends, key=lambda each: slopes[0] * each.point[-1])
        return found_between("fold", segment, located, nearer, slopes, fourier)

    def _told(
        self, found: Found, settled: Correction, segment: Segment, metric: Metric
    ) -> Event | None:
        """Return a settled event with its errors; None if it is no event."""
        error, aside, bend = found.error(), 0.0, found.bend
        if found.name == "fold":
            settled, arc = self._placed(found, settled, segment, metric)
            doubt = fold_error(self.system, segment, settled, bend)
            if doubt is None:
                return None
            length = abs(segment.length)
            arc = min(max(arc, doubt.arc), doubt.within)
            arc += length * (1.0 if found.aside else segment.precision)
            point, _, _ = self.system.report.kept(settled.point)
            error, aside = doubt.parameter, self.growth.over(settled, point, arc)
        elif found.name == "peak":
            seen = self.system, self.growth, segment
            error, aside = peak_error(*seen, settled, bend)
        return Event(settled, found.name, error + found.aside, aside)

    def _changes(
        self, segment: Segment, before: Settled, after: Settled
    ) -> Iterator[Found]:
        """Yield where stability changes."""
        crossings = Crossings(self.system, self.multipliers, self.recalls)
        for name, located, error in crossings.between(segment, before, after):
            place, fourier = segment.place(located.point), self.system.fourier
            yield Found(place, name, located, fourier, error=error)


def _zero(growth: tuple[float, float]) -> float:
    """Return where a growth is zero, over the step, as far as it is linear."""
    return growth[0] / (growth[0] - growth[1])
