"""What all methods of a comparison are given: problem, frequency, where to begin."""

from __future__ import annotations

import math
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.quantity import SceneError
from microslip.rigs import problem_of
from microslip.scene_tables import Scene
from microslip.studies.curve import trace_curve
from microslip.studies.orbit import PHASES, Orbit, rubs
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState
from timedomain.integrate import MarchOptions, integrate
from timedomain.start import Start, at_end, on_orbit
from timedomain.steady import Coordinates, Slope, slope_of, steady

SHARE = 0.99
"""of the highest peak's frequency: on the flank, where contacts slide"""
NEAR = 0.01
"""of a frequency, within which the highest stable point of the curve is taken"""
PERIODS = 2
"""that are marched at a time: of the second, what began anew is forgotten"""
SLOPE_STEPS = 2
"""per phase, of the march whose derivative all methods are given"""


class PrecisionError(MicroslipError):
    """Methods that cannot be compared at a frequency."""


@dataclass(frozen=True, slots=True)
class Carried:
    """What a method makes of a motion in :data:`PERIODS` periods."""

    end: Start
    orbit: Orbit
    """the last of the periods"""
    seconds: float
    """of one thread's processor, per period"""


@dataclass(frozen=True, slots=True)
class Result:
    """What a method finds at one setting."""

    orbit: Orbit
    seconds: float
    """of one thread's processor; of a march those of one period"""
    marches: bool
    """whether that is of one period, of many that pass before the motion is steady"""
    left: float = 0.0
    """estimated distance from the method's own steady state, over the vibration"""


@dataclass(frozen=True, slots=True)
class Case:
    """One periodic motion that all methods are asked for."""

    problem: Problem
    rest: StaticState
    guess: PeriodicResponse
    """of the curve, at the frequency that is asked for"""
    begun: float
    """seconds that harmonic balance takes to a first harmonic from nothing"""
    start: Start
    """of the guess, at phase 0"""
    slope: Slope
    """of a march of one period"""

    @property
    def frequency(self) -> float:
        """Of the drive [rad/s]."""
        return self.guess.frequency

    @property
    def duration(self) -> float:
        """Of :data:`PERIODS` periods [s]."""
        return PERIODS * math.tau / self.frequency

    def march(self, options: MarchOptions, start: Start) -> Carried:
        """March from a motion; rows must be stored at the phases."""
        return march(self.problem, self.frequency, options, PERIODS, start)


def case_of(scene: Scene, hertz: float | None = None) -> Case:
    """Return the case of a scene at a frequency [Hz].

    Without one it is that of the curve's highest peak times :data:`SHARE`.

    Raises
    ------
    PrecisionError
        If the curve has no stable point near it.
    SceneError
        If nothing drives the scene.
    KeyboardInterrupt
        If the curve is interrupted: its highest peak may be still to come.
    """
    problem = problem_of(scene)
    if not problem.drive.any():
        raise SceneError("nothing drives the scene: give a force")
    traced = trace_curve(problem, scene.curve)
    if traced.curve.ending == "interrupted":
        raise KeyboardInterrupt
    if hertz is None:
        highest = int(traced.curve.amplitude.max(axis=1).argmax())
        hertz = SHARE * float(traced.curve.frequency[highest]) / math.tau
    guess = _guess(traced.responses, problem, math.tau * hertz)
    for _ in range(2):  # the second one is warm
        begun = time.process_time()
        _first(problem, traced.rest, guess.frequency)
        begun = time.process_time() - begun
    start = on_orbit(problem, guess)
    march(
        problem,
        guess.frequency,
        MarchOptions(math.tau / guess.frequency / PHASES, 1),
        1,
        start,
    )  # compiled from here on
    return Case(
        problem, traced.rest, guess, begun, start, _slope(problem, guess, start)
    )


def steady_result(case: Case, carried: Callable[[Start], Carried]) -> Result:
    """Return what a march finds in its steady state."""
    fastest = math.inf

    def timed(start: Start) -> Carried:
        nonlocal fastest
        made = carried(start)
        fastest = min(fastest, made.seconds)
        return made

    found = steady(case.slope, timed, case.start, PERIODS)
    return Result(found.made.orbit, fastest, marches=True, left=found.left)


def march(
    problem: Problem,
    frequency: float,
    options: MarchOptions,
    periods: int,
    start: Start,
) -> Carried:
    """March some periods from a motion; the last one is measured."""
    duration = periods * math.tau / frequency
    began = time.process_time()
    (history,) = integrate(
        problem, Dwell(frequency, duration), options, start=start, block=duration
    )
    seconds = (time.process_time() - began) / periods
    taken = history.of("friction")
    if not rubs(problem):
        taken = taken + history.of("normal_damping") + history.of("structural_damping")
    # rows end their steps: phase 0 of the last period is the row before its first
    taken = np.append(0.0, taken)
    energy = float(taken[-1] - taken[-1 - PHASES])
    first = problem.probes.rows @ start.displacement
    shown = np.vstack([first, history.displacement])[-1 - PHASES : -1]
    assert history.checkpoint is not None
    return Carried(at_end(problem, history.checkpoint), Orbit(shown, energy), seconds)


def fixed_step(frequency: float, steps: int, method: str) -> MarchOptions:
    """Return options of equal steps, a multiple of :data:`PHASES` in each period."""
    stride = max(1, steps // PHASES)
    step = math.tau / frequency / (stride * PHASES)
    if method == "reference":
        return MarchOptions(step, stride, method="reference", residual=1e-12)
    return MarchOptions(step, stride)


def _guess(
    responses: tuple[PeriodicResponse, ...], problem: Problem, frequency: float
) -> PeriodicResponse:
    """Return the largest stable response near a frequency, taken to it."""
    near = [
        each
        for each in responses
        if abs(each.frequency / frequency - 1.0) <= NEAR and each.unstable <= 0
    ]
    if not near:
        raise PrecisionError(
            f"the curve has no stable point near {frequency / math.tau:g} Hz: give "
            "another --frequency, within its range"
        )
    nearest = min(abs(each.frequency - frequency) for each in near)
    rows = problem.probes.rows
    found = max(
        (each for each in near if abs(each.frequency - frequency) <= 3.0 * nearest),
        key=lambda each: float(np.linalg.norm(each.seen(rows)[1:3])),
    )
    return replace(found, frequency=frequency)


def _first(problem: Problem, rest: StaticState, frequency: float) -> None:
    """Find one harmonic from nothing, if there is one."""
    around = CurveOptions(frequency, 1.001 * frequency, harmonics=1, stability=False)
    try:
        next(frequency_response(problem, rest, around))
    except ContinuationError:
        return


def _slope(problem: Problem, guess: PeriodicResponse, start: Start) -> Slope:
    """Return the derivative of one period of the reference march."""
    displacement, velocity = guess.at(np.array([0.0, 0.5 * math.pi]))
    plain = Coordinates.of(problem, guess.frequency, 1.0)
    mean = plain.state(Start(guess.seen(np.eye(len(plain.root)))[0], 0.0 * velocity[0]))
    motions = zip(displacement, velocity, strict=True)
    vibration = max(
        float(np.linalg.norm(plain.state(Start(*each)) - mean)) for each in motions
    )
    options = fixed_step(guess.frequency, SLOPE_STEPS * PHASES, "reference")
    carried = partial(march, problem, guess.frequency, options, 1)
    coordinates = Coordinates.of(problem, guess.frequency, vibration)
    return slope_of(coordinates, carried, start, vibration)
