"""What the other solver makes of a curve under stress: shooting, or a march."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager
from dataclasses import replace

import numpy as np

from hbm.curves.periodic_response import with_multipliers
from microslip.errors import EXPECTED, one_line
from microslip.scenes.scene import Scene
from microslip.studies.clock import Clock, OutOfTimeError
from microslip.studies.dwell import dwelling
from microslip.studies.stress.condition import condition
from microslip.studies.stress.curve import Drawn
from microslip.studies.stress.finding import AGREED, Finding, Outcome, causes, judged
from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.shooting.closed_march import ShootingError
from timedomain.shooting.comparison import COVERAGE, compared
from timedomain.verify import agreement, march_periods

ENDS = ((0.79, 0.84), (0.91, 0.95))
"""shares of a case's time at which shooting, and a march, of each point are left; the
rest is for what heeds its end late"""
RESTING, LONGEST = 0.8, 1000
"""share of a case's time, and periods, at which a march from rest is left"""
LEFT = 0.1
"""relative change of the amplitude in a march that leaves an orbit; what is stable
stays, but for the march's own error, which a sharp resonance multiplies"""
Limit = AbstractContextManager[None]
PERIODS, STEPS = 30, 600
"""of the march that decides where shooting finds no orbit, and in a period of it"""
STAYS = AGREED / 3.0
"""relative change of the amplitude in it up to which the motion stays: damping of
0.2 % brings it a third of the way to another orbit"""


def witnessed(problem: Problem, drawn: Drawn, clock: Clock) -> Iterator[Finding]:
    """Yield what the other solver makes of points of a curve.

    One that is not what was asked for agrees within one per cent at best.
    """
    traced, said, _ = drawn
    curve = traced.curve
    places = _places(curve.amplitude.max(axis=1), curve.event)
    whole = curve.ending == "complete"
    told = said or ("" if whole else curve.ending)
    finding = Finding(
        cause=told and f"harmonic balance: {told}",
        points=curve.frequency.size,
        harmonics=int(curve.harmonics[places[0]]),
        iterations=float(curve.iterations.mean()),
        condition=condition(problem, traced, places[0]),
    )
    best = Outcome.WITHIN if said else Outcome.AGREES
    outcome = best if whole else Outcome.HONEST
    # of a curve that is not whole the largest orbit says enough
    for place, ends in zip(places if whole else places[:1], ENDS, strict=False):
        yield finding
        response = _examined(problem, drawn, place, clock.until(ends[0]))
        limits = tuple(clock.until(share) for share in ends)
        if math.isinf(response.error) and not said:
            doubt = "more harmonics do not confirm the orbit"
            doubt = f"harmonic balance {_where(response)}: {doubt}"
            finding = replace(finding, cause=causes(finding.cause, doubt))
        finding, worse = _beside(problem, response, finding, *limits)
        outcome = max(outcome, worse, key=list(Outcome).index)
    yield replace(finding, outcome=outcome)


def from_rest(problem: Problem, scene: Scene, clock: Clock) -> str:
    """Return whether a march from rest becomes steady where a curve does not begin."""
    frequency, distances = math.tau * scene.curve.lowest, [math.inf]
    marched = dwelling(problem, frequency, scene.march, tolerance=AGREED, most=LONGEST)
    try:
        with clock.until(RESTING):
            distances.extend(period.distance for period in marched)
    except OutOfTimeError:
        pass
    except EXPECTED as error:
        return f"marching from rest: {one_line(error)}"
    steady = "steady" if distances[-1] <= AGREED else "not steady"
    return f"a march from rest is {steady} there after {len(distances) - 1} periods"


def _places(amplitude: Array, event: Sequence[str]) -> list[int]:
    """Return the place of the largest amplitude, and one on the flank before it."""
    kept = np.flatnonzero([name in ("", "peak") for name in event])
    largest = int(kept[amplitude[kept].argmax()])
    high = kept[amplitude[kept] >= 0.5 * amplitude[largest]]
    return list(dict.fromkeys((largest, int(high[0]))))


def _examined(
    problem: Problem, drawn: Drawn, place: int, limit: Limit
) -> PeriodicResponse:
    """Return the response at a place, with its multipliers if there is time."""
    response = drawn.traced.responses[place]
    if drawn.options is None:
        return response
    try:
        with limit:
            return with_multipliers(problem, drawn.traced.rest, response, drawn.options)
    except OutOfTimeError:
        return response


def _where(response: PeriodicResponse) -> str:
    return f"at {response.frequency / math.tau:.6g} Hz"


def _beside(
    problem: Problem,
    response: PeriodicResponse,
    finding: Finding,
    shooting: Limit,
    marching: Limit,
) -> tuple[Finding, Outcome]:
    """Return what one point adds to a finding."""
    where = _where(response)
    try:
        with shooting:
            comparison = compared(problem, response)
    except (ShootingError, OutOfTimeError) as error:
        told = f"{where}: {one_line(error)}"
        return _marched(problem, response, finding, told, marching)
    except EXPECTED as error:
        cause = causes(finding.cause, f"shooting {where}: {one_line(error)}")
        return replace(finding, cause=cause), Outcome.HONEST
    outcome, cause = judged(comparison)
    return replace(
        finding,
        cause=causes(finding.cause, f"{where}: {cause}" if cause else ""),
        compared=finding.compared + 1,
        difference=_larger(finding.difference, comparison.difference),
        estimated=_larger(finding.estimated, comparison.admitted),
        steps=max(finding.steps, comparison.steps),
    ), outcome


def _marched(
    problem: Problem,
    response: PeriodicResponse,
    finding: Finding,
    said: str,
    limit: Limit,
) -> tuple[Finding, Outcome]:
    """Return whether the motion stays on an orbit that shooting has not found."""
    said = f"no orbit by shooting {said}"
    if response.unstable > 0:
        return replace(finding, cause=causes(finding.cause, said)), Outcome.HONEST
    marching = march_periods(problem, response, periods=PERIODS, steps_per_period=STEPS)
    try:
        with limit:
            found = agreement(problem, response, list(marching))
    except (*EXPECTED, OutOfTimeError) as error:
        cause = causes(finding.cause, f"{said}; marching: {one_line(error)}")
        return replace(finding, cause=cause), Outcome.HONEST
    size = max(float(found.predicted.max(initial=0.0)), TINY)
    apart = float(np.abs(found.marched - found.predicted).max(initial=0.0)) / size
    stays = apart <= STAYS and found.last_distance <= AGREED
    told = f"{said}; a march of {PERIODS} periods is {apart:.1e} away"
    added = replace(
        finding,
        cause=causes(finding.cause, told),
        compared=finding.compared + 1,
        difference=_larger(finding.difference, apart),
        steps=max(finding.steps, STEPS),
    )
    if stays:
        return added, Outcome.WITHIN
    left = apart > LEFT and apart > COVERAGE * response.error
    return (
        added,
        Outcome.DISAGREES if left and not response.unstable else Outcome.HONEST,
    )


def _larger(known: float, other: float) -> float:
    return other if math.isnan(known) else max(known, other)
