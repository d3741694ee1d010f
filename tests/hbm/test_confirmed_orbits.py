"""Where friction falls with the speed, orbits of few harmonics must be confirmed."""

from dataclasses import replace

import numpy as np
import pytest

from hbm.curves.periodic_response import periodic_response, with_multipliers
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from timedomain.shooting.comparison import compared

HERTZ = 2.0 * np.pi


def falling_friction() -> Problem:
    """Return the rig whose friction falls to a half within a millimetre per second.

    That is within what the element's speed changes in a sample.
    """
    return rig_problem(
        model="B",
        friction__law="gkf",
        friction__mu_dynamic=0.1,
        friction__mu_static=0.2,
        friction__stribeck_velocity=1e-3,
    )


@pytest.mark.parametrize("frequency", [145.0, 143.0])
def test_no_orbit_is_farther_away_than_its_error_admits(frequency: float) -> None:
    problem = falling_friction()
    options = CurveOptions(HERTZ * frequency, HERTZ * 150.0, error=5e-3)

    first = next(frequency_response(problem, static_equilibrium(problem), options))
    found = compared(problem, first)

    assert found.agrees


@pytest.mark.parametrize("frequency", [136.28, 145.0])
def test_multipliers_that_a_curve_left_out_are_those_that_it_would_have(
    frequency: float,
) -> None:
    problem = falling_friction()
    rest = static_equilibrium(problem)
    options = CurveOptions(HERTZ * frequency, HERTZ * 150.0, error=5e-3)
    without = replace(options, stability=False)

    known = next(frequency_response(problem, rest, options))
    plain = next(frequency_response(problem, rest, without))
    found = with_multipliers(problem, rest, plain, options)

    assert plain.multipliers.size == 0
    assert found.multipliers.size == known.multipliers.size
    leading = np.abs(known.multipliers[:3])
    np.testing.assert_allclose(np.abs(found.multipliers[:3]), leading, rtol=1e-4)
    assert found.error == known.error


def test_multipliers_are_those_of_friction_that_a_curve_had_smoothed() -> None:
    problem = rig_problem(model="A", friction__threshold_velocity=1e-4)
    rest = static_equilibrium(problem)
    options = CurveOptions(HERTZ * 140.0, HERTZ * 150.0, error=5e-3, stability=False)

    smooth = next(frequency_response(problem, rest, options))
    sharp = periodic_response(
        problem, rest, smooth, harmonics=smooth.harmonics, samples=smooth.samples
    )
    found, known = (
        with_multipliers(problem, rest, each, options) for each in (smooth, sharp)
    )

    np.testing.assert_allclose(
        np.abs(found.multipliers), np.abs(known.multipliers), atol=1e-9
    )
