"""Shooting of a mass that a stop with a dashpot throws back: a force that jumps."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.record.start import on_orbit
from timedomain.shooting.closed_march import closed
from timedomain.shooting.comparison import compared
from timedomain.shooting.period_map import PeriodMap
from timedomain.shooting.periodic_orbit import first_harmonic
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit


def struck() -> Problem:
    """Return a mass that strikes a stop with a dashpot."""
    stop = UnilateralSpring(stiffness=5e3, gap=1e-3, damping=2.0)
    return system(
        mass=[2.0 / 3.0],
        stiffness=[1e3],
        damping=[1.0],
        elements=[Element(stop, between=("x1", "ground"))],
        drive={"x1": 2.0 / 3.0},
    )


@pytest.mark.long
def test_orbits_are_found_where_the_force_jumps_as_faces_touch() -> None:
    problem = struck()
    start, end = 2.0 * np.pi * 7.84, 2.0 * np.pi * 7.9
    rest = static_equilibrium(problem)
    points = frequency_response(problem, rest, CurveOptions(start, end))

    found = [compared(problem, each) for each in points if not each.event]

    assert len(found) > 5
    assert all(each.agrees for each in found)
    assert np.mean([each.as_estimated for each in found]) > 0.95


@pytest.mark.parametrize("hertz", [7.0, 7.2, 7.4])
def test_orbits_are_of_second_order_though_a_force_jumps_within_a_step(
    hertz: float,
) -> None:
    problem, frequency = struck(), 2.0 * np.pi * hertz
    rest = static_equilibrium(problem)
    options = CurveOptions(frequency, 1.001 * frequency, stability=False)
    response = next(frequency_response(problem, rest, options))
    start = on_orbit(problem, response)

    maps = [PeriodMap.of(problem, frequency, 256 * 2**each) for each in range(7)]
    found = [first_harmonic(closed(each, each.state(start))) for each in maps]

    *amplitudes, exact = np.hypot(*np.array(found)[:, :, 0].T)
    errors = np.abs(np.array(amplitudes)[:-1] / exact - 1.0)
    assert errors[0] < 4e-4
    assert np.all(errors < 1.5 * errors[0] / 4.0 ** np.arange(errors.size))


@pytest.mark.parametrize("hertz", [7.0, 7.2, 7.4])
def test_the_error_of_an_orbit_is_honest(hertz: float) -> None:
    problem, frequency = struck(), 2.0 * np.pi * hertz
    rest = static_equilibrium(problem)
    options = CurveOptions(frequency, 1.001 * frequency, stability=False)
    response = next(frequency_response(problem, rest, options))
    start = on_orbit(problem, response)

    reference, *orbits = (
        periodic_orbit(problem, frequency, start=start, options=each)
        for each in (
            ShootingOptions(16384, 1.0, 32768),
            ShootingOptions(256, 1e-4, 8192),
            ShootingOptions(256, 1e-5, 8192),
        )
    )

    for orbit in orbits:
        true = np.abs(orbit.amplitude / reference.amplitude - 1.0).max()
        assert true <= orbit.error < 5e-4


@pytest.mark.parametrize("hertz", [164.0, 165.14, 165.85, 167.0, 167.4])
def test_an_orbit_near_a_fold_is_found_and_its_error_is_small(hertz: float) -> None:
    stop = UnilateralSpring(stiffness=7.5e4, gap=6e-5, damping=7.5)
    springs = PolynomialSpring({1.5: 4.1e5, 2.5: 7.9e8})
    problem = system(
        mass=[0.109],
        stiffness=[7e4],
        damping=[2.9],
        elements=[
            Element(springs, between=("x1", "ground")),
            Element(stop, between=("x1", "ground")),
            Element(stop, between=("ground", "x1")),
        ],
        drive={"x1": 1.32},
    )
    start, end = 2.0 * np.pi * 145.0, 2.0 * np.pi * hertz
    rest = static_equilibrium(problem)
    options = CurveOptions(start, end, error=1e-4, events=False)
    curve = frequency_response(problem, rest, options)
    loud = next(each for each in curve if each.frequency == end)

    found = compared(problem, loud)

    assert loud.unstable == 0
    assert np.hypot(*loud.coefficients[1:3, 0]) > 1.5e-4  # beyond both gaps
    assert found.steps == 1024
    assert found.difference < found.found_error + 1e-4 < 2e-4
    assert found.as_stable
