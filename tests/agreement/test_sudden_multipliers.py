"""Multipliers by shooting where forces jump as faces touch, against integration."""

from collections.abc import Callable

import numpy as np
import pytest

from flights import (
    beside_a_slider,
    flight_multipliers,
    lifting,
    remembering,
    rubbing_multipliers,
)
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from timedomain.record.start import on_orbit
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit


def first(problem: Problem, frequency: float) -> PeriodicResponse:
    """Return the response at a frequency."""
    options = CurveOptions(frequency, 1.02 * frequency, error=1e-6, events=False)
    return next(iter(frequency_response(problem, static_equilibrium(problem), options)))


def agrees(
    problem: Problem, response: PeriodicResponse, expected: ComplexArray, bound: float
) -> None:
    """Check the multipliers by shooting, and that their told errors are honest."""
    orbit = periodic_orbit(
        problem,
        response.frequency,
        start=on_orbit(problem, response),
        options=ShootingOptions(steps=2048, error=1.0, most=4096),
    )

    away = np.abs(orbit.multipliers[:, None] - expected)
    nearest = away.argmin(axis=0)  # sliders that slip have others
    aside = away[nearest, np.arange(expected.size)]
    assert aside.max() < bound
    assert (aside <= orbit.multiplier_error[nearest]).all()


@pytest.mark.parametrize("frequency", [25.0, 32.0, 38.0])
@pytest.mark.parametrize("masses", [lifting, remembering])
def test_viscous_friction_that_begins_as_faces_touch(
    masses: Callable[[float], Problem], frequency: float
) -> None:
    problem = masses(4.0)
    response = first(problem, frequency)

    agrees(problem, response, rubbing_multipliers(4.0, response), 1e-4)


@pytest.mark.parametrize("hertz", [5.2, 5.4, 5.6])
def test_a_damper_in_a_stop(hertz: float) -> None:
    problem = problem_of(load_scene("gap", ["element.stop.damping=5"]))
    response = first(problem, 2.0 * np.pi * hertz)

    agrees(problem, response, flight_multipliers(problem, response), 6e-4)


@pytest.mark.parametrize("frequency", [33.0, 38.0, 42.0])
def test_a_damper_in_a_stop_beside_a_slider(frequency: float) -> None:
    problem = beside_a_slider(10.0)
    response = first(problem, frequency)

    agrees(problem, response, flight_multipliers(problem, response), 3e-4)
