"""What all methods of a comparison are given: problem, frequency, where to begin."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.quantity import SceneError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene import Scene
from microslip.studies.curve import trace_curve
from microslip.studies.march_size import demand_dense
from microslip.studies.precision.march import PERIODS, Carried, fixed_step, march
from microslip.studies.precision.orbit import PHASES
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState
from timedomain.integrate import MarchOptions
from timedomain.record.start import Start, on_orbit
from timedomain.shooting.steady import Coordinates, Slope, slope_of

SHARE = 0.99
"""of the highest peak's frequency: on the flank, where contacts slide"""
NEAR = 0.01
"""of a frequency, within which the highest stable point of the curve is taken"""
SLOPE_STEPS = 2
"""per phase, of the march whose derivative all methods are given"""


class PrecisionError(MicroslipError):
    """Methods that cannot be compared at a frequency."""


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
    ValueError
        If its structure is sparse.
    KeyboardInterrupt
        If the curve is interrupted: its highest peak may be still to come.
    """
    problem = problem_of(scene)
    demand_dense(problem)
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
