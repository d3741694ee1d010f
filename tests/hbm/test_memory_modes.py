"""Modes and equivalent springs of contacts that remember, by describing functions."""

import numpy as np
import pytest

from hbm.forces.equivalent import equivalent_contact, free_structure, stuck_structure
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import modes_in_range, nonlinear_mode
from hbm.one_harmonic import one_harmonic_response
from hbm.structure.poles import poles
from memory_problems import JENKINS, LIMIT, STIFFNESS
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.contact.points import ELASTIC, PointLaw, contact_table
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.structure import Structure

DAMPING, SPRING = 0.4, 45.0


def oscillator(law: PointLaw = JENKINS) -> Problem:
    """Return a mass of 1 kg beside a slider."""
    one = np.eye(1)
    return Problem(
        Structure(one, DAMPING * one, SPRING * one, ("x",)),
        Interface(contact_table([law]), np.eye(3)[:, 1:2], ("slider",)),
        np.zeros(1),
        np.array([0.5]),
        Probes(("x",), one),
    )


def describing(amplitude: float) -> complex:
    """Return the first harmonic of a Jenkins element over that of its motion [N/m]."""
    times = amplitude * STIFFNESS / LIMIT
    if times <= 1.0:
        return complex(STIFFNESS)
    turn = np.arccos(1.0 - 2.0 / times)
    in_phase = STIFFNESS / np.pi * (turn - 0.5 * np.sin(2.0 * turn))
    return complex(in_phase, 4.0 * LIMIT / (np.pi * amplitude) * (1.0 - 1.0 / times))


def test_the_linear_mode_sticks() -> None:
    problem = oscillator()
    (mode,) = modes_in_range(problem, static_equilibrium(problem), 1.0, 20.0)

    assert mode.frequency == pytest.approx(np.sqrt(SPRING + STIFFNESS), rel=1e-12)


def test_a_contact_that_is_apart_does_not_stick() -> None:
    law = PointLaw(
        stiffness=60.0, gap=0.1, friction=ELASTIC, dynamic=0.4, tangential=STIFFNESS
    )
    problem = oscillator(law)
    (mode,) = modes_in_range(problem, static_equilibrium(problem), 1.0, 20.0)

    assert mode.frequency == pytest.approx(np.sqrt(SPRING), rel=1e-12)


def test_the_mode_of_one_harmonic_is_that_of_the_describing_function() -> None:
    problem = oscillator()
    rest = static_equilibrium(problem)
    (linear,) = modes_in_range(problem, rest, 1.0, 20.0)
    slip = LIMIT / STIFFNESS
    options = ModeOptions(0.5 * slip, 100.0 * slip, harmonics=1)

    points = list(nonlinear_mode(problem, rest, linear, options))

    assert points[0].frequency == pytest.approx(np.sqrt(SPRING + STIFFNESS), rel=1e-6)
    assert points[-1].frequency == pytest.approx(np.sqrt(SPRING), rel=0.01)
    assert max(point.damping for point in points) > 0.05
    for point in points:
        stiff = SPRING + describing(point.amplitude)
        (exact,) = (each for each in np.roots([1.0, DAMPING, stiff]) if each.imag > 0.0)
        # 128 samples of a period
        assert abs(point.pole - exact) < 2e-3 * abs(exact)


def test_a_response_has_the_equivalent_spring_of_the_describing_function() -> None:
    problem = oscillator()
    rest = static_equilibrium(problem)

    response = one_harmonic_response(problem, rest, (4.0, 12.0), 8.0)
    found = equivalent_contact(problem, response)

    amplitude = float(np.hypot(*response.coefficients[1:3, 0]))
    assert amplitude > 2.0 * LIMIT / STIFFNESS
    exact = describing(amplitude)
    assert found.stiffness[1] == pytest.approx(exact.real, rel=1e-3)
    assert 8.0 * found.damping[1] == pytest.approx(exact.imag, rel=1e-3)


def test_without_sliding_it_is_a_spring_and_without_friction_nothing() -> None:
    problem = oscillator()
    rest = static_equilibrium(problem)

    held = stuck_structure(problem, rest)
    assert held is not None
    stuck = poles(held).values
    free = poles(free_structure(problem, rest)).values

    assert np.abs(stuck) == pytest.approx([np.sqrt(SPRING + STIFFNESS)])
    assert np.abs(free) == pytest.approx([np.sqrt(SPRING)])
