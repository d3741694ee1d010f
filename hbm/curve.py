"""A traced curve with what happens on it: responses in order, events among them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from hbm.adaptive import AdaptiveBalance
from hbm.continuation import Metric
from hbm.errors import ContinuationError
from hbm.events import (
    PRECISION,
    ROUGH,
    ROUGHER,
    SURE,
    Segment,
    crossings,
    excess,
    folds,
)
from hbm.fourier import FourierBasis
from hbm.multipliers import Multipliers
from hbm.newton import Correction, Outcome
from hbm.residual import HarmonicBalance
from hbm.resolution import PathResolution
from hbm.step_control import StepControl
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import ONE_SIDED
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse

TURN = 2.0 * np.pi
DRIFT = 1e-6
"""mean force on a free body over the force scale, from which it drifts"""
LOCATING = FourierBasis(31, 256)
"""most that is taken between two points to locate a change of stability"""
STRICT, SHARP = 0.1, ("fold", "peak")
"""share of the error of a point that these events may have: they mark a frequency"""
LEAP = 0.1
"""of the change of a multiplier between two points: what is left of its excess where it
is located, from which on it leaps"""
UPRIGHT = 0.1
"""part of the parameter in a unit tangent below which a multiplier +1 is a fold's"""


@dataclass(frozen=True, slots=True)
class Curve:
    """What turns the corrections of a trace into periodic responses."""

    problem: Problem
    system: AdaptiveBalance
    resolution: PathResolution
    control: StepControl
    multipliers: Multipliers
    events: bool
    """whether they are located"""

    def followed(
        self, corrections: Iterable[Correction], metric: Metric, beginning: str = ""
    ) -> Iterator[PeriodicResponse]:
        """Yield the response at each point, and at each event between two points.

        ``beginning`` is what the first point is marked as.
        """
        before: tuple[Correction, Made] | None = None
        for correction in corrections:
            mark = beginning if before is None else "restart"
            made = self._made(correction, "" if correction.joined else mark)
            if self.events and before is not None and correction.joined:
                yield from self._between(*before, correction, made, metric)
            yield made.response
            before = correction, made

    def _between(
        self,
        before: Correction,
        last: Made,
        after: Correction,
        made: Made,
        metric: Metric,
    ) -> Iterator[PeriodicResponse]:
        """Yield the events between two neighbouring points, in their order."""
        fourier = self.system.fourier
        self.system.fourier = self.system.settled
        scale, tolerance = metric(before.point), self.control.tolerance
        loose = self.control.loose if self.control.negligible else 0.0
        segment = Segment(self.system, before, after, scale, tolerance, loose)
        tests = self._tests(last, made)
        found = [
            (segment.place(located.point), test.name, located)
            for test in tests
            if (located := segment.locate(*test[1:])) is not None
            and not (test.ends and self._leaps(test.function(located), test.ends))
        ]
        for _, name, located in sorted(_told(found, scale), key=itemgetter(0)):
            normal = located.along / metric(located.point) ** 2
            normal /= np.abs(normal).max()
            small = segment.small(PRECISION * SURE)
            share = STRICT if name in SHARP else 1.0
            settled = self.system.settle(located, normal, tolerance, small, share)
            moved = float(np.linalg.norm((settled.point - located.point) / scale))
            if settled.outcome is Outcome.CONVERGED and moved < segment.length:
                yield self._made(settled, name).response
        self.system.fourier = fourier

    def _tests(self, last: Made, made: Made) -> list[Test]:
        """Return what is to be located between two responses."""
        tests = [Test("fold", folds), Test("peak", self._slope, falling=True)]
        before, after = last.response.multipliers, made.response.multipliers
        finer = self._asked(last, made)
        rough = ROUGH if finer is None else ROUGHER
        for which, kind in crossings(before, after):
            ends = excess(before, which), excess(after, which)
            tests.append(Test(kind, partial(self._growth, which, finer), ends, rough))
        return tests

    def _leaps(self, left: float, ends: tuple[float, float]) -> bool:
        """Return whether a multiplier leaps over the unit circle: nothing branches.

        It does where a slider begins to slip, or sticks for good. What is ``left`` of a
        test function at its located zero shows it.
        """
        recalls = bool(remembers(self.problem.interface.points).any())
        return recalls and abs(left) > LEAP * abs(ends[1] - ends[0])

    def _asked(self, last: Made, made: Made) -> FourierBasis | None:
        """Return the resolution that multipliers between two points ask for, if any."""
        finer = max(last.finer, made.finer, key=lambda each: each.harmonics)
        if finer.harmonics <= 2 * self.system.fourier.harmonics + 1:
            return None
        most = replace(LOCATING, threshold=finer.threshold)
        return min(finer, most, key=lambda each: each.harmonics)

    def _slope(self, correction: Correction) -> float:
        """Return the change of the largest amplitude along the curve."""
        point, along = correction.point, correction.along
        # Without contact the frequency is all that changes.
        moved = slice(None, -1) if along[:-1].any() else slice(-1, None)
        small = 1e-6 * float(
            np.linalg.norm(point[moved]) / np.linalg.norm(along[moved])
        )
        sizes = [
            self.resolution.amplitudes(point + sign * small * along)
            for sign in (-1.0, 1.0)
        ]
        place = int(sizes[0].argmax())
        return float(sizes[1][place] - sizes[0][place]) / small

    def _growth(
        self, which: int, finer: FourierBasis | None, correction: Correction
    ) -> float:
        """Return by how much a multiplier exceeds one, by its place in their order.

        What has asked for ``finer`` orbits at an end does so between the ends.
        """
        point, fourier = correction.point, self.system.fourier
        if finer is not None:
            found = self.multipliers.finer(point, finer)
            point, fourier = (point, fourier) if found is None else (found, finer)
        return excess(self.multipliers.at(point, fourier), which)

    def _made(self, correction: Correction, event: str) -> Made:
        """Return the response at a settled point."""
        kept, fourier, error = self.system.kept(correction.point)
        balance, point = self.resolution.at(fourier).at_frequency(kept)
        made = response(self.problem, balance, replace(correction, point=point))
        points = self.problem.interface.points
        presses = (points.normal == ONE_SIDED) & (points.stiffness > 0.0)
        multipliers, finer, confirmed = self.multipliers.sure(
            kept, fourier, made.normal_smallest[presses]
        )
        told = replace(
            made,
            error=error if confirmed else np.inf,
            event=event,
            multipliers=multipliers,
            parameter=float(kept[-1]),
        )
        return Made(told, finer)


class Made(NamedTuple):
    """A response, and the resolution that its multipliers ask for."""

    response: PeriodicResponse
    finer: FourierBasis


class Test(NamedTuple):
    """What happens where a function vanishes."""

    name: str
    function: Callable[[Correction], float]
    ends: tuple[float, float] | None = None
    """its values at both points, if they are known better"""
    precision: float = PRECISION
    falling: bool = False
    """whether it must change from above zero to below"""


Found = tuple[float, str, Correction]
"""place along a segment, name, point"""


def _told(found: Sequence[Found], scale: Array) -> list[Found]:
    """Return the events without the branch points that are folds.

    At a fold, where the curve is upright, a multiplier is +1 as well.
    """
    return [
        (place, name, located)
        for place, name, located in found
        if name != "branch point" or abs(located.along[-1] / scale[-1]) > UPRIGHT
    ]


def response(
    problem: Problem, balance: HarmonicBalance, correction: Correction
) -> PeriodicResponse:
    """Return the periodic response at a corrected point.

    Raises
    ------
    ContinuationError
        If a body that nothing holds drifts.
    """
    point = correction.point
    drift, frequency = balance.drift_force(point), float(point[-1])
    if drift > DRIFT * problem.force_scale:
        raise ContinuationError(
            f"a body drifts at {frequency / TURN:.6g} Hz: friction has a mean of "
            f"{drift:.2g} N and nothing holds the body; give it a rope"
        )
    cycle = balance.cycle(point)
    return PeriodicResponse(
        frequency,
        balance.motion(point),
        cycle.normal_smallest,
        cycle.normal_largest,
        cycle.friction,
        cycle.normal_damping,
        correction.residuals[-1],
        correction.outcome.name.lower(),
        correction.iterations,
        balance.fourier.harmonics,
        balance.fourier.samples,
    )
