"""Rigid friction: harmonic balance, set-valued march, regularised law in the limit."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from law_examples import driven
from microslip_mechanics.element import Element
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.rigid_coulomb import RigidCoulomb
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.record.start import Start
from timedomain.shooting.comparison import compared
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit
from timedomain.verify import agreement, march_periods

Laws = RigidCoulomb | RegularisedCoulomb


def block(law: Laws) -> Problem:
    """Return 1 kg on 1 N/m, driven by 1 N, that rubs."""
    return system(
        mass=[1.0],
        stiffness=[[1.0]],
        damping=[[0.1]],
        names=("x",),
        elements=[Element(law, tangents=[("x", "ground")])],
        drive={"x": 1.0},
    )


def response(problem: Problem, frequency: float) -> PeriodicResponse:
    options = CurveOptions(frequency, 1.001 * frequency, harmonics=31, samples=1024)
    return next(frequency_response(problem, static_equilibrium(problem), options))


@pytest.mark.parametrize(
    ("limit", "frequency"), [(0.5, 1.3), (0.6, 0.4), (0.85, 0.7)],
    ids=["slides", "stops twice", "mostly stuck"],
)  # fmt: skip
def test_march_stays_on_the_orbit(limit: float, frequency: float) -> None:
    problem = block(RigidCoulomb(mu=1.0, load=limit))
    found = response(problem, frequency)
    blocks = list(march_periods(problem, found, periods=40, steps_per_period=960))
    compared = agreement(problem, found, blocks)
    assert found.friction_energy > 0.1
    assert compared.deviation.max() < 3e-4
    assert compared.closing_error < 1e-4


@pytest.mark.parametrize("case", ["rigid coulomb", "rigid coulomb, variable load"])
def test_march_comes_closer_to_sliding_in_a_plane_as_steps_shrink(case: str) -> None:
    problem = driven(case)
    found = response(problem, 6.5)
    coarse, fine = (
        agreement(
            problem,
            found,
            list(march_periods(problem, found, periods=40, steps_per_period=steps)),
        ).deviation.max()
        for steps in (180, 720)
    )
    assert fine < 1e-4
    assert fine < 0.15 * coarse


@pytest.mark.parametrize("case", ["rigid coulomb", "rigid coulomb, variable load"])
def test_shooting_finds_the_orbit(case: str) -> None:
    problem = driven(case)
    made = compared(problem, response(problem, 6.5))
    assert made.agrees
    assert made.difference < 1e-4
    assert 0.1 < made.found_multiplier < 1.0


def test_multipliers_of_the_march_are_those_of_motions_that_turn() -> None:
    limit, frequency = 0.5, 1.3
    problem = block(RigidCoulomb(mu=1.0, load=limit))
    found = response(problem, frequency)
    displacement, velocity = found.at(np.zeros(1))
    orbit = periodic_orbit(
        problem, frequency, start=Start(displacement[0], velocity[0])
    )
    # the product: damping, and at both turns the slope of the velocity after it over
    # that before it (Liouville; Aizerman and Gantmakher)
    phase = np.linspace(0.0, 2.0 * np.pi, 20001)
    shown = found.at(phase)[0][:, 0]
    top = shown.argmax()
    pull = np.sin(phase[top]) - shown[top]
    turns = ((pull + limit) / (pull - limit)) ** 2
    expected = np.exp(-0.1 * 2.0 * np.pi / frequency) * turns
    product = np.prod(orbit.multipliers)
    assert product.real == pytest.approx(expected, rel=0.02)
    assert abs(product.imag) < 1e-6


@pytest.mark.parametrize(
    ("limit", "frequency", "side"),
    [(0.5, 1.3, 1.0), (0.6, 0.4, -1.0)],
    ids=["from above", "from below"],
)
def test_regularised_friction_comes_to_it_as_its_threshold_falls(
    limit: float, frequency: float, side: float
) -> None:
    rigid = response(block(RigidCoulomb(mu=1.0, load=limit)), frequency)
    amplitude = np.hypot(*rigid.coefficients[1:3, 0])
    displacement, velocity = rigid.at(np.zeros(1))
    apart = []
    for threshold in (0.02, 0.01, 0.005):
        law = RegularisedCoulomb(mu=1.0, load=limit, threshold_velocity=threshold)
        orbit = periodic_orbit(
            block(law),
            frequency,
            start=Start(displacement[0], velocity[0]),
            options=ShootingOptions(steps=1024, error=1e-4),
        )
        apart.append(side * (orbit.amplitude[0] / amplitude - 1.0))
    assert apart[2] > 5e-4
    assert apart[1] / apart[0] == pytest.approx(0.5, abs=0.03)
    assert apart[2] / apart[1] == pytest.approx(0.5, abs=0.03)
    assert abs(2.0 * apart[2] - apart[1]) < 2e-4
