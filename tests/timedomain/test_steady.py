"""Steady states of marches, and the periods that a march has to wait for."""

import dataclasses
from functools import partial

import numpy as np
import pytest

from convergence import observed_order
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from small_problems import oscillator
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.checkpoint import at_end
from timedomain.record.start import Start, at_rest
from timedomain.shooting.steady import Coordinates, Slope, slope_of, steady

FREQUENCY = 380.0
PERIOD = 2.0 * np.pi / FREQUENCY


@dataclasses.dataclass(frozen=True)
class Marched:
    end: Start
    largest: float


def linear() -> Problem:
    return oscillator(stiffness=3e5, damping=12.0, preload=0.0)


def march(problem: Problem, steps: int, periods: int, start: Start) -> Marched:
    options = MarchOptions(PERIOD / steps, 1, method="reference", residual=1e-12)
    dwell = Dwell(FREQUENCY, periods * PERIOD)
    (history,) = integrate(problem, dwell, options, start=start, block=1e3)
    assert history.checkpoint is not None
    shown = history.displacement[-steps:, 0]
    first = 2.0 * np.fft.rfft(shown)[1] / steps
    return Marched(at_end(problem, history.checkpoint), float(np.abs(first)))


def slope(problem: Problem) -> Slope:
    coordinates = Coordinates.of(problem, FREQUENCY, 1.0)
    return slope_of(coordinates, partial(march, problem, 512, 1), at_rest(problem), 1.0)


def test_the_steady_state_of_a_march_converges_to_the_linear_response() -> None:
    problem = linear()
    exact = 1.5 / abs(3e5 - 2.0 * FREQUENCY**2 + 12.0j * FREQUENCY)
    found = slope(problem)

    steps, errors = [128, 256, 512], []
    for count in steps:
        made = steady(found, partial(march, problem, count, 2), at_rest(problem), 2)
        assert made.left < 1e-9
        errors.append(abs(made.made.largest / exact - 1.0))

    assert observed_order([1.0 / n for n in steps], errors) == pytest.approx(
        2.0, abs=0.1
    )


def test_the_slowest_multiplier_is_that_of_the_damping() -> None:
    assert slope(linear()).slowest == pytest.approx(np.exp(-3.0 * PERIOD), rel=1e-5)


def test_a_transient_is_below_an_error_after_the_periods_told() -> None:
    problem = linear()
    found = slope(problem)
    wanted = steady(found, partial(march, problem, 512, 1), at_rest(problem), 1)
    goal = found.coordinates.state(wanted.made.end)
    before = float(np.linalg.norm(goal))
    periods = found.periods(1e-3)

    end = march(problem, 512, periods, at_rest(problem)).end

    left = float(np.linalg.norm(found.coordinates.state(end) - goal)) / before
    assert 1e-4 < left < 2e-3
