"""Bodies that only sticking friction holds: a slider that sticks is a spring."""

import numpy as np
import pytest

from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.record.start import on_orbit
from timedomain.shooting.periodic_orbit import PeriodicOrbit
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit

STICKS = 400.0
"""k_t of what sticks [N/m]"""
FREQUENCY = 16.0
"""[rad/s]"""


def rubbing(*, floats: bool) -> Problem:
    """Return a mass that slips under a load that varies, so that friction has a mean.

    Another slider, which sticks, holds it; or a spring in its place.
    """
    law = ElasticFriction(normal_stiffness=300.0, stiffness=200.0, mu=0.3)
    elements = [Element(law, normal=("z", "ground"), tangents=[("x", "ground")])]
    if floats:
        holds = Jenkins(stiffness=STICKS, limit=100.0)
        elements.append(Element(holds, between=("x", "ground")))
    spring = 0.0 if floats else STICKS
    return system(
        names=["x", "z"],
        mass=[1.0, 1.0],
        stiffness=[[spring, 0.0], [0.0, 100.0]],
        damping=[[1.0, 0.0], [0.0, 2.0]],
        elements=elements,
        preload={"z": 20.0},
        drive={"x": 8.0, "z": 6.0},
    )


def response(problem: Problem) -> PeriodicResponse:
    """Return the response at one frequency."""
    options = CurveOptions(FREQUENCY, 1.02 * FREQUENCY, error=1e-5, events=False)
    return next(iter(frequency_response(problem, static_equilibrium(problem), options)))


def orbit(problem: Problem, begun: PeriodicResponse) -> PeriodicOrbit:
    """Return the orbit by shooting."""
    return periodic_orbit(
        problem,
        begun.frequency,
        start=on_orbit(problem, begun),
        options=ShootingOptions(steps=1024, error=1e-5),
    )


def test_a_slider_that_sticks_holds_a_body_as_a_spring_does() -> None:
    held, floats = (response(rubbing(floats=each)) for each in (False, True))

    count = min(len(held.coefficients), len(floats.coefficients))
    size = np.abs(held.coefficients).max()
    away = np.abs(held.coefficients[:count] - floats.coefficients[:count]).max()
    assert abs(held.coefficients[0, 0]) > 0.01 * size  # friction has a mean
    assert held.friction_energy > 0.01
    assert away < 1e-5 * size
    assert floats.friction_energy == pytest.approx(held.friction_energy, rel=1e-4)
    moduli = [np.sort(np.abs(each.multipliers))[::-1] for each in (held, floats)]
    np.testing.assert_allclose(moduli[0][:4], moduli[1][:4], atol=1e-4)


def test_shooting_finds_the_same_orbit() -> None:
    problem = rubbing(floats=True)
    begun = response(problem)

    found = orbit(problem, begun)

    assert found.stuck.tolist() == [False, True]
    size = np.abs(begun.coefficients).max()
    away = np.abs(found.coefficients[:3] - begun.coefficients[:3]).max()
    assert away < 1e-4 * size
    largest = np.abs(found.multipliers).max()
    assert np.abs(begun.multipliers).max() == pytest.approx(largest, abs=1e-3)


def test_faces_that_nothing_presses_are_named() -> None:
    law = ElasticFriction(normal_stiffness=1e4, preload=10.0, stiffness=5e3, mu=0.3)
    problem = system(
        names=["x", "z"],
        mass=[1.0, 1.0],
        stiffness=[[100.0, 0.0], [0.0, 0.0]],
        rayleigh_damping=(1.0, 0.0),
        elements=[Element(law, normal=("z", "ground"), tangents=[("x", "ground")])],
        drive={"x": 1.0, "z": 2.0},
    )

    with pytest.raises(ContinuationError, match="a preload of the structure"):
        response(problem)
