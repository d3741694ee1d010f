"""Stiff and extreme cases by both solvers: what agrees, what ends with a cause."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from enum import Enum
from functools import partial
from typing import Any

import numpy as np
from scipy.linalg import lapack

from hbm.continuation import ContinuationError
from hbm.fourier import FourierBasis
from hbm.path import along_frequency
from microslip.quantity import SceneError
from microslip.rigs import problem_of
from microslip.scene_file import Scene, load_scene
from microslip.studies.bounded import Ended, bounded
from microslip.studies.curve import Traced, trace_curve
from microslip.studies.stress_cases import Case
from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from timedomain.closed_march import ShootingError
from timedomain.comparison import Comparison, compared
from timedomain.shooting import ShootingOptions
from timedomain.verify import agreement, march_periods

AGREED = 0.01
"""relative difference of amplitudes up to which the solvers agree"""
TOLERANCE = "curve.tolerance=5e-3"
"""half of what is asked, unless the curve is told otherwise"""
TRACING, SHOOTING = 0.4, 0.15
"""shares of a case's time after which its curve, and each orbit, is left"""
PERIODS, STEPS = 30, 600
"""of the march that decides where shooting finds no orbit, and in a period of it"""
EXPECTED = (MicroslipError, ValueError, ArithmeticError, RuntimeWarning, MemoryError)
"""what ends a command in one line"""


class Outcome(Enum):
    """How a case ended."""

    AGREES = "agrees"
    WITHIN = "agrees within 1 %"
    HONEST = "honest outcome"
    DISAGREES = "disagrees"
    REFUSED = "refused"


@dataclass(frozen=True, slots=True)
class Finding:
    """What was found of a case so far."""

    outcome: Outcome = Outcome.HONEST
    cause: str = ""
    """why it is not better; empty where the solvers agree as both estimate"""
    points: int = 0
    """of the curve"""
    harmonics: int = 0
    """at the largest amplitude"""
    iterations: float = 0.0
    """Newton's, per point of the curve"""
    compared: int = 0
    """points at which the other solver has come to an end"""
    difference: float = math.nan
    """largest one of the amplitudes, relative"""
    estimated: float = math.nan
    """what both solvers estimate of it"""
    steps: int = 0
    """of a period in time"""
    condition: float = math.nan
    """of harmonic balance's Jacobian at the largest amplitude, in the 1-norm"""


@dataclass(frozen=True, slots=True)
class Tried:
    """A case and how it went."""

    case: Case
    finding: Finding
    seconds: float


def tried(
    scene: str,
    overrides: Sequence[str],
    chosen: Sequence[Case],
    *,
    seconds: float,
    processes: int,
) -> Iterator[Tried]:
    """Yield how each case goes, as they end; none takes longer than ``seconds``.

    A case whose time is over, or whose process dies, keeps what was found of it.
    """
    task = partial(_studied, scene, tuple(overrides), seconds)
    prepare = partial(_prepare, scene, tuple(overrides))
    for ended in bounded(
        task, chosen, seconds=seconds, processes=processes, prepare=prepare
    ):
        yield Tried(ended.item, _last(ended), ended.seconds)


def rate(found: Sequence[Tried]) -> tuple[int, int]:
    """Return how many cases agree within 1 % in both solvers, and of how many."""
    solved = [each for each in found if not each.case.refusals]
    good = (Outcome.AGREES, Outcome.WITHIN)
    return sum(each.finding.outcome in good for each in solved), len(solved)


def _last(ended: Ended[Case]) -> Finding:
    finding = ended.result or Finding()
    if not ended.cause:
        return finding
    # an exception that no command expects, or a process that died, is a defect
    late = ended.cause.startswith("out of time")
    outcome = Outcome.HONEST if late else Outcome.DISAGREES
    cause = "; ".join(filter(None, (ended.cause, finding.cause)))
    return replace(finding, outcome=outcome, cause=cause)


def _prepare(scene: str, overrides: tuple[str, ...]) -> None:
    """Have all machine code made: the scene's own case with both laws, roughly."""
    rough = ("curve.harmonics=3", "curve.samples=64")
    for more in ((), ("friction.law=gkf",)):
        for _ in _studied(scene, overrides, math.inf, Case("", "", (*more, *rough))):
            pass


def _studied(
    scene: str, overrides: tuple[str, ...], seconds: float, case: Case
) -> Iterator[Finding]:
    """Yield what is found of a case, better and better."""
    clock = _Clock(seconds)
    if case.refusals:
        yield from _refused(scene, overrides, case, clock)
        return
    own = scene, (TOLERANCE, *overrides, *case.overrides)
    if case.scene is not None:
        own = case.scene, (TOLERANCE, *case.overrides)
    try:
        loaded = load_scene(*own)
        problem = problem_of(loaded)
        traced = trace_curve(problem, loaded.curve, clock.watch)
    except EXPECTED as error:
        yield Finding(cause=f"harmonic balance: {_line(error)}")
        return
    yield from _compared(problem, traced, SHOOTING * seconds)


class _Clock:
    """Ends a curve at its share of the time, between two points."""

    def __init__(self, seconds: float) -> None:
        self._end = time.process_time() + seconds
        self._traced = time.process_time() + TRACING * seconds

    @property
    def over(self) -> bool:
        """Whether the curve's share is over."""
        return time.process_time() > self._traced

    def watch(self, items: Any) -> Iterator[Any]:  # noqa: ANN401  (what a watch takes)
        """Pass items through until the time is over."""
        for item in items:
            yield item
            if self.over:
                raise ContinuationError("out of time on the curve")


def _compared(problem: Problem, traced: Traced, seconds: float) -> Iterator[Finding]:
    """Yield what the other solver makes of points of a curve."""
    curve = traced.curve
    places = _places(curve.amplitude.max(axis=1), curve.event)
    whole = curve.ending == "complete"
    finding = Finding(
        cause="" if whole else f"harmonic balance: {curve.ending}",
        points=curve.frequency.size,
        harmonics=int(curve.harmonics[places[0]]),
        iterations=float(curve.iterations.mean()),
        condition=_condition(problem, traced, places[0]),
    )
    outcome = Outcome.AGREES if whole else Outcome.HONEST
    for place in places:
        yield finding
        finding, worse = _beside(problem, traced.responses[place], finding, seconds)
        outcome = max(outcome, worse, key=list(Outcome).index)
    yield replace(finding, outcome=outcome)


def _places(amplitude: Array, event: Sequence[str]) -> list[int]:
    """Return the place of the largest amplitude, and one on the flank before it."""
    kept = np.flatnonzero([name in ("", "peak") for name in event])
    largest = int(kept[amplitude[kept].argmax()])
    high = kept[amplitude[kept] >= 0.5 * amplitude[largest]]
    return list(dict.fromkeys((largest, int(high[0]))))


def _beside(
    problem: Problem, response: PeriodicResponse, finding: Finding, seconds: float
) -> tuple[Finding, Outcome]:
    """Return what one point adds to a finding."""
    where = f"at {response.frequency / math.tau:.6g} Hz"
    try:
        comparison = compared(problem, response, ShootingOptions(seconds=seconds))
    except ShootingError as error:
        return _marched(problem, response, finding, f"{where}: {_line(error)}")
    except EXPECTED as error:
        cause = _and(finding.cause, f"shooting {where}: {_line(error)}")
        return replace(finding, cause=cause), Outcome.HONEST
    outcome, cause = judged(comparison)
    return replace(
        finding,
        cause=_and(finding.cause, f"{where}: {cause}" if cause else ""),
        compared=finding.compared + 1,
        difference=_larger(finding.difference, comparison.difference),
        estimated=_larger(finding.estimated, comparison.admitted),
        steps=max(finding.steps, comparison.steps),
    ), outcome


def judged(comparison: Comparison) -> tuple[Outcome, str]:
    """Return the outcome of a comparison, and its cause if it is not the best."""
    apart = f"amplitudes differ by {comparison.difference:.1e}"
    if comparison.difference > AGREED:
        if comparison.agrees:
            return Outcome.HONEST, f"{apart}, as the estimates admit"
        return Outcome.DISAGREES, f"{apart}; {comparison.admitted:.1e} is estimated"
    if not comparison.agrees:
        return Outcome.WITHIN, f"{apart}; {comparison.admitted:.1e} is estimated"
    if not comparison.as_stable:
        return Outcome.WITHIN, (
            f"largest multiplier {comparison.multiplier:.5g} and "
            f"{comparison.found_multiplier:.5g}"
        )
    return Outcome.AGREES, ""


def _marched(
    problem: Problem, response: PeriodicResponse, finding: Finding, said: str
) -> tuple[Finding, Outcome]:
    """Return whether the motion stays on an orbit that shooting has not found."""
    said = f"no orbit by shooting {said}"
    if response.unstable > 0:
        return replace(finding, cause=_and(finding.cause, said)), Outcome.HONEST
    try:
        blocks = list(
            march_periods(problem, response, periods=PERIODS, steps_per_period=STEPS)
        )
        found = agreement(problem, response, blocks)
    except EXPECTED as error:
        cause = _and(finding.cause, f"{said}; marching: {_line(error)}")
        return replace(finding, cause=cause), Outcome.HONEST
    size = max(float(found.predicted.max(initial=0.0)), 1e-300)
    apart = float(np.abs(found.marched - found.predicted).max(initial=0.0)) / size
    stays = apart <= AGREED and found.last_distance <= AGREED
    told = f"{said}; a march of {PERIODS} periods is {apart:.1e} away"
    added = replace(
        finding,
        cause=_and(finding.cause, told),
        compared=finding.compared + 1,
        difference=_larger(finding.difference, apart),
        steps=max(finding.steps, STEPS),
    )
    return added, Outcome.WITHIN if stays else Outcome.HONEST


def _condition(problem: Problem, traced: Traced, place: int) -> float:
    """Return the condition of harmonic balance's Jacobian at a place of the curve."""
    response = traced.responses[place]
    if problem.structure.sparse:
        return math.nan
    frequency = response.frequency
    path = along_frequency(problem, traced.rest, frequency, frequency)
    balance = path.balance(FourierBasis(response.harmonics, response.samples))
    rows = path.problem.map_from(problem.interface.displacement)
    _, linearised = balance(balance.point(response.seen(rows), frequency))
    jacobian = linearised.jacobian
    if jacobian.size == 0:
        return 1.0
    size = float(np.abs(jacobian).sum(axis=0).max())
    factors, _, failed = lapack.dgetrf(jacobian)
    share, _ = lapack.dgecon(factors, size)
    return math.inf if failed or share == 0.0 else 1.0 / float(share)


def _refused(
    scene: str, overrides: tuple[str, ...], case: Case, clock: _Clock
) -> Iterator[Finding]:
    """Yield whether each bad value is refused in a line, or computed to the end."""
    refused, computed, wrong = 0, 0, []
    for each in case.refusals:
        try:
            loaded = load_scene(scene, (*overrides, *each))
            finite = _finite(loaded, clock)
        except EXPECTED as error:
            named = isinstance(error, SceneError) or case.parameter == "1e308"
            if named and len(str(error).splitlines()) <= 1:
                refused += 1
            else:
                wrong.append(f"{each[0]}: {_line(error)}")
        else:
            computed += finite
            if not finite or case.parameter != "1e308":
                wrong.append(f"{each[0]}: taken as it is")
        outcome = Outcome.DISAGREES if wrong else Outcome.REFUSED
        counts = f"{refused} refused" + (f", {computed} computed" if computed else "")
        yield Finding(outcome, "; ".join((counts, *wrong)), compared=refused + computed)


def _finite(loaded: Scene, clock: _Clock) -> bool:
    """Return whether the curve of a scene is finite as far as it goes."""
    if clock.over:
        raise ContinuationError("out of time before the value was tried")
    curve = replace(loaded.curve, harmonics=3, samples=64)
    traced = trace_curve(problem_of(loaded), curve, clock.watch)
    return bool(np.isfinite(traced.curve.amplitude).all())


def _line(error: BaseException) -> str:
    return " ".join(str(error).split()) or type(error).__name__


def _and(before: str, more: str) -> str:
    return "; ".join(filter(None, (before, more)))


def _larger(known: float, other: float) -> float:
    return other if math.isnan(known) else max(known, other)
