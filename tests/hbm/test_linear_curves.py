"""Curves of problems that are linear: without contact, pressed together, glued."""

import dataclasses
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize

from contact_tables import contact_points, linear_contact
from hbm.errors import ContinuationError
from hbm.forces.fourier import to_complex
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import NORMAL, cantilever, mass_on_contact, oscillator

TURN = 2.0 * np.pi
GLUE = 1e3
"""friction coefficient that keeps the rig's faces a hundred times below V_lim"""


def linear_curve(
    problem: Problem, *, lowest: float, highest: float, largest_step: float = 0.25
) -> list[PeriodicResponse]:
    """Return the responses from one frequency [Hz] to another; few samples will do."""
    options = CurveOptions(
        TURN * lowest,
        TURN * highest,
        harmonics=2,
        samples=16,
        tolerance=1e-10,
        largest_step=largest_step,
    )
    return list(frequency_response(problem, static_equilibrium(problem), options))


def first_harmonic(response: PeriodicResponse) -> ComplexArray:
    harmonic: ComplexArray = to_complex(response.coefficients)[1]
    return harmonic


def dynamic_stiffness(problem: Problem, frequency: float) -> ComplexArray:
    structure, s = problem.structure, 1j * frequency
    matrix: ComplexArray = (
        structure.stiffness + s * structure.damping + s**2 * structure.mass
    )
    return matrix


def deviation(value: ComplexArray, exact: ComplexArray) -> float:
    return float(np.abs(value - exact).max() / np.abs(exact).max())


def touching_without_force() -> Problem:
    """Return the cantilever with a contact at its tip that exerts no force."""
    beam = cantilever()
    points = contact_points(stiffness=0.0, damping=0.0, friction=0)
    rows = np.vstack([np.zeros_like(beam.probes.rows[:1]), beam.probes.rows])
    return dataclasses.replace(beam, interface=Interface(points, rows, ("tip",)))


@pytest.mark.parametrize("make", [cantilever, touching_without_force])
def test_a_beam_without_contact_responds_by_its_transfer_function(
    make: Callable[[], Problem],
) -> None:
    problem = make()

    curve = linear_curve(problem, lowest=20.0, highest=90.0)

    for response in curve:
        dynamic = dynamic_stiffness(problem, response.frequency)
        exact = np.linalg.solve(dynamic, -1j * problem.drive)
        assert deviation(first_harmonic(response), exact) < 1e-8


def test_an_oscillator_without_contact_responds_in_closed_form() -> None:
    mass, damping, stiffness, force = 2.0, 0.5, 300.0, 1.5
    problem = oscillator(mass=mass, damping=damping, stiffness=stiffness, drive=force)

    curve = linear_curve(problem, lowest=0.5, highest=4.0)

    for response in curve:
        ratio = response.frequency**2 * mass
        size = force / np.hypot(stiffness - ratio, damping * response.frequency)
        lag = np.arctan2(damping * response.frequency, stiffness - ratio)
        expected = size * np.array([-np.sin(lag), np.cos(lag)])
        np.testing.assert_allclose(
            response.coefficients[1:3, 0], expected, atol=1e-8 * size
        )


def test_a_mass_pressed_on_a_linear_contact_responds_in_closed_form() -> None:
    mass, stiffness, damping, press, force = 2.0, 300.0, 1.5, 4.0, 0.5
    points = linear_contact(stiffness, damping)
    problem = mass_on_contact(
        points, direction=NORMAL, mass=mass, preload=press, drive=force
    )
    highest = np.sqrt(stiffness / mass) / TURN

    # Up to a fifth below the resonance the contact stays closed, but for the motion
    # that lifts off, from beyond that.
    curve = linear_curve(problem, lowest=0.2 * highest, highest=0.8 * highest)

    for response in itertools.takewhile(lambda each: each.event != "restart", curve):
        s = 1j * response.frequency
        exact = -1j * force / (stiffness + s * damping + s**2 * mass)
        assert abs(first_harmonic(response)[0] - exact) < 1e-8 * abs(exact)
        assert response.coefficients[0, 0] == pytest.approx(press / stiffness)
        contact = abs(exact) * abs(stiffness + s * damping)
        # Sixteen samples miss the extreme by up to (π / 16)² / 2 of the vibration.
        assert response.normal_smallest == pytest.approx(
            press - contact, abs=0.02 * contact
        )
        assert response.normal_smallest > 0.0
        energy = np.pi * damping * response.frequency * abs(exact) ** 2
        assert response.damping_energy == pytest.approx(energy, rel=1e-7)


def glued(coefficient: float) -> Problem:
    """Return rig A with so much friction that its faces never reach V_lim."""
    return rig_problem(model="A", friction__mu_dynamic=coefficient)


def with_dashpots(problem: Problem, frequency: float) -> ComplexArray:
    """Return the dynamic stiffness of rig A with its friction as dashpots µN/V_lim.

    Axial motion of the rig leaves the normal forces alone, by its plane of symmetry;
    their springs are those at rest.
    """
    points, rows = problem.interface.points, problem.interface.displacement
    depth = rows[0::3] @ static_equilibrium(problem).displacement
    matrix = dynamic_stiffness(problem, frequency)
    springs = 2.0 * points.stiffness * depth
    dashpots = points.dynamic * points.load / points.threshold
    matrix += (rows[0::3].T * springs) @ rows[0::3]
    for tangent in (1, 2):
        matrix += 1j * frequency * (rows[tangent::3].T * dashpots) @ rows[tangent::3]
    return matrix


def stuck_motion(problem: Problem, frequency: float) -> ComplexArray:
    """Return the first harmonic of the rig with all contacts glued."""
    free = scipy.linalg.null_space(problem.interface.displacement)
    dynamic = free.T @ dynamic_stiffness(problem, frequency) @ free
    motion: ComplexArray = free @ np.linalg.solve(dynamic, free.T @ problem.drive)
    return -1j * motion


def test_friction_that_sticks_responds_as_a_linear_dashpot() -> None:
    problem = glued(GLUE)

    curve = linear_curve(problem, lowest=125.0, highest=145.0)

    for response in curve:
        matrix = with_dashpots(problem, response.frequency)
        exact = np.linalg.solve(matrix, -1j * problem.drive)
        assert deviation(first_harmonic(response), exact) < 1e-8


def test_glued_faces_respond_as_the_stuck_structure() -> None:
    problem = glued(GLUE)

    curve = linear_curve(problem, lowest=125.0, highest=145.0)

    # Faces that carry a force F creep by F V_lim / µN: the difference is of first
    # order in V_lim / µN. Measured 8e-6, next to the resonance.
    for response in curve:
        exact = stuck_motion(problem, response.frequency)
        assert deviation(first_harmonic(response), exact) < 8e-5


def test_the_difference_from_the_stuck_structure_falls_with_the_creep() -> None:
    errors = []
    for coefficient in (GLUE, 10.0 * GLUE):
        problem = glued(coefficient)
        response = linear_curve(problem, lowest=134.0, highest=134.5)[-1]
        exact = stuck_motion(problem, response.frequency)
        errors.append(deviation(first_harmonic(response), exact))

    assert errors[0] / errors[1] == pytest.approx(10.0, rel=0.01)


def test_glued_faces_resonate_at_the_stuck_mode() -> None:
    problem, structure = glued(GLUE), glued(GLUE).structure
    free = scipy.linalg.null_space(problem.interface.displacement)
    squares = scipy.linalg.eigh(
        free.T @ structure.stiffness @ free,
        free.T @ structure.mass @ free,
        eigvals_only=True,
    )
    stuck = np.sqrt(squares[0]) / TURN

    # Steps of a twentieth of the range's tenth: of 0.02 Hz, where Q is 400.
    curve = linear_curve(
        problem, lowest=stuck - 0.2, highest=stuck + 0.2, largest_step=0.5
    )

    amplitudes = [np.abs(first_harmonic(response)).max() for response in curve]
    place = int(np.argmax(amplitudes))
    spacing = 0.5 * 0.04
    assert 0 < place < len(curve) - 1
    assert curve[place].frequency / TURN == pytest.approx(stuck, abs=spacing)


def test_the_usual_steps_do_not_miss_the_resonance_of_sticking_faces() -> None:
    problem = rig_problem(model="A", excitation__force=0.05)

    usual = linear_curve(problem, lowest=125.0, highest=145.0)
    fine = linear_curve(problem, lowest=134.5, highest=135.5, largest_step=0.1)

    seen, exact = (
        max(np.abs(first_harmonic(response)).max() for response in curve)
        for curve in (usual, fine)
    )
    # Next to a resonance steps are short where they follow the vibration.
    assert seen == pytest.approx(exact, rel=0.05)


@pytest.mark.parametrize("harmonics", [2, None])
def test_the_peak_of_an_oscillator_is_located(harmonics: int | None) -> None:
    mass, damping, stiffness = 2.0, 0.5, 300.0
    problem = oscillator(mass=mass, damping=damping, stiffness=stiffness)
    options = CurveOptions(TURN * 0.5, TURN * 4.0, harmonics=harmonics)

    curve = frequency_response(problem, static_equilibrium(problem), options)

    peaks = [response.frequency for response in curve if response.event == "peak"]
    exact = np.sqrt(stiffness / mass - damping**2 / (2.0 * mass**2))
    assert peaks == pytest.approx([exact], rel=1e-5)


def test_a_dip_between_two_resonances_is_no_peak() -> None:
    problem = system(
        mass=[2.0, 1.0],
        stiffness=[[500.0, -200.0], [-200.0, 200.0]],
        damping=[[0.5, -0.2], [-0.2, 0.2]],
        drive={"x1": 1.5},
        probes=["x1"],
    )
    options = CurveOptions(TURN * 0.5, TURN * 4.0, harmonics=2)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    def amplitude(frequency: float) -> float:
        dynamic = dynamic_stiffness(problem, frequency)
        return float(np.abs(np.linalg.solve(dynamic, problem.drive)[0]))

    undamped = np.sqrt(
        scipy.linalg.eigh(
            problem.structure.stiffness, problem.structure.mass, eigvals_only=True
        )
    )
    exact = [
        scipy.optimize.minimize_scalar(
            lambda frequency: -amplitude(frequency),
            bounds=(0.9 * mode, 1.1 * mode),
            method="bounded",
            options={"xatol": 1e-9},
        ).x
        for mode in undamped
    ]
    dip = min(curve, key=lambda response: amplitude(response.frequency)).frequency
    assert exact[0] < dip < exact[1]
    peaks = [response.frequency for response in curve if response.event == "peak"]
    assert peaks == pytest.approx(exact, rel=1e-5)


@pytest.mark.parametrize("damping_ratio", [0.3, 1e-2, 1e-4, 1e-8])
def test_resonances_much_closer_than_a_step_are_each_found(
    damping_ratio: float,
) -> None:
    weak = 1e-4
    problem = system(
        mass=[1.0, 1.0],
        stiffness=[[1e3 + weak, -weak], [-weak, 1e3]],
        damping_ratio=damping_ratio,
        drive={"x1": 1.0},
        probes=["x1"],
    )
    options = CurveOptions(TURN * 7.0, TURN * 4.0)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    squares, shapes = np.linalg.eigh(problem.structure.stiffness)
    modes = np.sqrt(squares)

    def growth(frequency: float) -> float:
        below = squares - frequency**2 + 2j * damping_ratio * modes * frequency
        slope = -2.0 * frequency + 2j * damping_ratio * modes
        motion, change = shapes[0] ** 2 @ np.array([1.0 / below, -slope / below**2]).T
        return float((motion.conj() * change).real)

    wide = 3.0 * damping_ratio * modes
    grid = np.unique(
        np.concatenate(
            [np.linspace(TURN * 4.0, TURN * 7.0, 500)]
            + [
                np.linspace(mode - each, mode + each, 500)
                for mode, each in zip(modes, wide, strict=True)
            ]
        )
    )
    signs = np.sign([growth(each) for each in grid])
    exact = [
        scipy.optimize.brentq(growth, float(grid[i]), float(grid[i + 1]), xtol=1e-12)
        for i in np.flatnonzero((signs[:-1] > 0.0) & (signs[1:] < 0.0))
        if TURN * 4.0 < grid[i] < TURN * 7.0
    ]
    frequencies = [response.frequency for response in curve]
    assert frequencies == sorted(frequencies, reverse=True)
    peaks = [response for response in curve if response.event == "peak"]
    found = [response.frequency for response in peaks]
    assert len(exact) == 1 + (damping_ratio < 1e-6)
    assert found == pytest.approx(exact[::-1], rel=1e-12)
    assert all(response.parameter_error < 1e-9 for response in peaks)


@pytest.mark.parametrize("lowest", [TURN * 0.5, 0.5 * math.sqrt(150.0)])
def test_a_resonance_without_damping_has_no_peak_and_no_point(lowest: float) -> None:
    problem = oscillator(mass=2.0, damping=0.0, stiffness=300.0)
    # the second range has the resonance in its middle
    options = CurveOptions(lowest, 2.0 * math.sqrt(150.0) - lowest)

    natural, curve = np.sqrt(150.0), list[PeriodicResponse]()
    points = frequency_response(problem, static_equilibrium(problem), options)
    hertz = f"{natural / math.tau:.6f}"
    with pytest.raises(ContinuationError, match=f"no bound at {hertz}.* Hz: nothing"):
        curve.extend(points)

    assert not any(response.event for response in curve)
    beside = [abs(response.frequency / natural - 1.0) for response in curve]
    assert 1e-9 < min(beside) < 1e-6


def test_a_range_may_be_in_numbers_of_numpy() -> None:
    problem = oscillator()
    ends = TURN * np.array([1.0, 2.0])

    up, down = (
        frequency_response(problem, static_equilibrium(problem), CurveOptions(*span))
        for span in (ends, ends[::-1])
    )

    found = [each.frequency for each in up]
    assert found == [each.frequency for each in down][::-1]
