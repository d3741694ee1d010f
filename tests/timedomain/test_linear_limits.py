"""Problems that are linear: the march against transfer functions."""

import numpy as np
import pytest

from contact_tables import linear_contact
from convergence import observed_order
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system
from small_problems import (
    NORMAL,
    cantilever,
    dwelled,
    from_rest,
    last_harmonic,
    mass_on_contact,
    oscillator,
)
from timedomain.fast.coordinates import modal_coordinates
from timedomain.record.start import Start


def transfer(problem: Problem, frequency: float) -> ComplexArray:
    """Return the first harmonic of all degrees of freedom under drive · sin ωt."""
    structure, s = problem.structure, 1j * frequency
    dynamic = structure.stiffness + s * (structure.damping + s * structure.mass)
    motion: ComplexArray = np.linalg.solve(dynamic, -1j * problem.drive)
    return motion


@pytest.mark.kernels
def test_a_march_stays_on_the_orbit_of_the_average_acceleration_rule() -> None:
    problem, frequency, steps = cantilever(elements=2), 150.0, 40
    time_step = 2.0 * np.pi / frequency / steps

    # The rule takes (2/h) tan(ωh/2) for ω, and nothing else changes.
    seen_as = 2.0 / time_step * np.tan(frequency * time_step / 2.0)
    orbit = transfer(problem, seen_as)
    start = Start(orbit.real, -seen_as * orbit.imag)
    history = dwelled(problem, frequency, periods=3, steps=steps, start=start)

    phase = frequency * history.time
    expected = np.outer(np.exp(1j * phase), problem.probes.rows @ orbit).real
    size = np.abs(expected).max()
    # Rounding; measured 4e-12.
    np.testing.assert_allclose(history.displacement, expected, atol=4e-11 * size)


def test_the_amplitude_of_a_beam_converges_to_the_transfer_function() -> None:
    problem, frequency = cantilever(), 150.0
    exact = problem.probes.rows @ transfer(problem, frequency)
    steps = [60, 120, 240]

    errors = []
    for each in steps:
        # After 40 periods the first modes have decayed by e⁻¹⁶.
        history = dwelled(problem, frequency, periods=40, steps=each)
        errors.append(np.abs(last_harmonic(history) - exact).max())

    order = observed_order([1.0 / each for each in steps], errors)
    assert order == pytest.approx(2.0, abs=0.1)


def test_a_beam_extrapolated_to_short_steps_is_its_transfer_function_to_1e_8() -> None:
    problem, frequency = cantilever(), 150.0
    exact = problem.probes.rows @ transfer(problem, frequency)
    motion = transfer(problem, frequency)
    start = Start(motion.real, -frequency * motion.imag)

    coarse, fine = (
        last_harmonic(dwelled(problem, frequency, periods=60, steps=steps, start=start))
        for steps in (400, 800)
    )

    # Steps of second order leave an error of fourth order after Richardson.
    limit = (4.0 * fine - coarse) / 3.0
    assert np.abs(limit - exact).max() < 1e-8 * np.abs(exact).max()


def test_an_oscillator_settles_on_its_transfer_function_to_1e_8() -> None:
    natural = 10.0
    problem = oscillator(
        mass=1.0, damping=0.2 * natural, stiffness=natural**2, drive=1.0
    )
    frequency = 0.3 * natural
    exact = transfer(problem, frequency)

    # From rest; the start decays by e⁻²⁵ and the error of a step is (ωh)² / 60.
    history = dwelled(problem, frequency, periods=12, steps=20_000)

    assert np.abs(last_harmonic(history) - exact).max() < 1e-8 * np.abs(exact).max()


def test_a_mass_pressed_on_a_linear_contact_settles_on_its_transfer_function() -> None:
    stiffness, damping, press, force = 300.0, 6.0, 4.0, 0.5
    points = linear_contact(stiffness, damping)
    problem = mass_on_contact(
        points, direction=NORMAL, mass=2.0, preload=press, drive=force
    )
    frequency = 4.0
    s = 1j * frequency
    exact = -1j * force / (stiffness + s * damping + s**2 * 2.0)

    errors = []
    for steps in (100, 200, 400):
        history = dwelled(
            problem, frequency, periods=20, steps=steps, start=from_rest(problem)
        )
        assert history.normal_force.min() > 0.0
        errors.append(abs(last_harmonic(history)[0] - exact))

    order = observed_order([0.01, 0.005, 0.0025], errors)
    assert order == pytest.approx(2.0, abs=0.1)


@pytest.mark.kernels
def test_a_soft_mass_beside_a_stiff_one_keeps_its_spring() -> None:
    stiff = np.array([(2.0 * np.pi) ** 2, 4e13])

    modes = modal_coordinates(system(mass=[1.0, 1.0], stiffness=stiff)).modes

    np.testing.assert_allclose(np.sort(modes.stiffness), stiff, rtol=1e-12)


@pytest.mark.kernels
def test_a_chain_that_nothing_holds_moves_freely() -> None:
    count = 30
    chain = 2.0 * np.eye(count) - np.eye(count, k=1) - np.eye(count, k=-1)
    chain[0, 0] = chain[-1, -1] = 1.0
    mass = np.random.default_rng(1).uniform(0.1, 10.0, count)

    problem = system(mass=mass, stiffness=1e6 * chain, probes=["x1"])
    modes = modal_coordinates(problem).modes

    assert np.count_nonzero(modes.stiffness == 0.0) == 1
