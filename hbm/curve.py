"""A traced curve with what happens on it: responses in order, events among them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

import numpy as np

from hbm.adaptive import AdaptiveBalance, Resolution
from hbm.continuation import ContinuationError, Metric, StepControl
from hbm.events import Segment, folds
from hbm.newton import Correction, Outcome
from hbm.residual import HarmonicBalance
from hbm.stability import SmallMotions
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse

DRIFT = 1e-6
"""mean force on a free body over the force scale, from which it drifts"""


@dataclass(frozen=True, slots=True)
class Curve:
    """What turns the corrections of a trace into periodic responses."""

    problem: Problem
    system: AdaptiveBalance
    resolution: Resolution
    control: StepControl
    motions: SmallMotions | None
    """for stability, if it is wanted"""

    def followed(
        self, corrections: Iterable[Correction], metric: Metric
    ) -> Iterator[PeriodicResponse]:
        """Yield the response at each point, and at each event between two points."""
        before: Correction | None = None
        last: PeriodicResponse | None = None
        for correction in corrections:
            joined = before is not None and correction.joined
            made = self._made(correction, "" if joined or before is None else "restart")
            if joined and before is not None and last is not None:
                yield from self._between(before, correction, last, made, metric)
            yield made
            before, last = correction, made

    def _between(
        self,
        before: Correction,
        after: Correction,
        last: PeriodicResponse,
        made: PeriodicResponse,
        metric: Metric,
    ) -> Iterator[PeriodicResponse]:
        """Yield the events between two neighbouring points, in their order."""
        fourier = self.system.fourier
        self.system.fourier = self.system.settled
        segment = Segment(
            self.system, before, after, metric(before.point), self.control.tolerance
        )
        found = [
            (name, place)
            for name, test in self._tests(last, made)
            if (place := segment.locate(test)) is not None
        ]
        events = []
        for name, place in found:
            settled = self.system.settle(
                place, metric(place.point), self.control.tolerance
            )
            if settled.outcome is Outcome.CONVERGED:
                events.append(self._made(settled, name))
        self.system.fourier = fourier
        forward = after.point[-1] >= before.point[-1]
        yield from sorted(
            events, key=lambda each: each.frequency if forward else -each.frequency
        )

    def _tests(
        self, last: PeriodicResponse, made: PeriodicResponse
    ) -> list[tuple[str, Callable[[Correction], float]]]:
        """Return what is to be located: names and functions that vanish there."""
        tests: list[tuple[str, Callable[[Correction], float]]] = [
            ("fold", folds),
            ("peak", self._slope),
        ]
        if last.unstable >= 0 and made.unstable != last.unstable:
            kind = crossing(last.multipliers, made.multipliers)
            tests.append((kind, self._growth))
        return tests

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

    def _growth(self, correction: Correction) -> float:
        """Return by how much the largest multiplier exceeds one."""
        multipliers = self._multipliers(
            self.resolution.at(self.system.fourier), correction.point
        )
        return float(np.abs(multipliers).max(initial=0.0) - 1.0)

    def _multipliers(self, balance: HarmonicBalance, point: Array) -> ComplexArray:
        if self.motions is None:
            return np.empty(0, complex)
        coefficients, frequency = balance.split(point)
        balance.contact(coefficients, frequency)
        return self.motions.multipliers(balance.contact, frequency)

    def _made(self, correction: Correction, event: str) -> PeriodicResponse:
        """Return the response at a settled point."""
        point, fourier, error = self.system.kept(correction.point)
        balance = self.resolution.at(fourier)
        made = response(self.problem, balance, replace(correction, point=point))
        multipliers = np.empty(0, complex)
        if self.motions is not None:
            multipliers = self.motions.multipliers(balance.contact, made.frequency)
        return replace(made, error=error, event=event, multipliers=multipliers)


def crossing(before: ComplexArray, after: ComplexArray) -> str:
    """Return how stability changes between two sets of Floquet multipliers.

    The multiplier that is outside the unit circle tells: at +1, where the curve does
    not fold, another branch begins; at −1 a period doubles; elsewhere a torus begins.
    """
    outside = max(before[0], after[0], key=abs)
    if abs(outside.imag) > 1e-6 * abs(outside):
        return "Neimark-Sacker"
    return "branch point" if outside.real > 0.0 else "period doubling"


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
            f"a body drifts at {frequency:.6g} rad/s: friction has a mean of "
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
