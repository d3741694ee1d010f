"""Frequency response curves: linear limits, balances and ends."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
import scipy.linalg

from contact_tables import contact_points
from hbm.continuation import ContinuationError
from hbm.fourier import FourierBasis, to_complex
from hbm.residual import HarmonicBalance
from hbm.solve import CurveOptions, frequency_response, periodic_response
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import NORMAL, cantilever, mass_on_contact, oscillator

TURN = 2.0 * np.pi
GLUE = 1e3
"""friction coefficient that keeps the rig's faces a hundred times below V_lim"""


def curve_of(
    problem: Problem,
    *,
    lowest: float = 125.0,
    highest: float = 145.0,
    harmonics: int = 8,
    samples: int = 1024,
    tolerance: float = 1e-8,
    largest_step: float = 0.25,
) -> list[PeriodicResponse]:
    """Return the responses from one frequency [Hz] to another."""
    options = CurveOptions(
        TURN * lowest,
        TURN * highest,
        harmonics,
        samples,
        tolerance=tolerance,
        largest_step=largest_step,
    )
    return list(frequency_response(problem, static_equilibrium(problem), options))


def linear_curve(
    problem: Problem, *, lowest: float, highest: float, tolerance: float = 1e-10
) -> list[PeriodicResponse]:
    """Return the responses of a problem that is linear: few samples will do."""
    return curve_of(
        problem,
        lowest=lowest,
        highest=highest,
        harmonics=2,
        samples=16,
        tolerance=tolerance,
    )


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
    points = contact_points(
        stiffness=stiffness,
        exponent=1.0,
        damping=damping,
        damping_exponent=0.0,
        friction=0,
    )
    problem = mass_on_contact(
        points, direction=NORMAL, mass=mass, preload=press, drive=force
    )
    highest = np.sqrt(stiffness / mass) / TURN

    # Up to a fifth below the resonance the contact stays closed.
    curve = linear_curve(problem, lowest=0.2 * highest, highest=0.8 * highest)

    for response in curve:
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

    # Steps of a tenth of the half-power bandwidth.
    curve = curve_of(
        problem,
        lowest=stuck - 0.2,
        highest=stuck + 0.2,
        harmonics=1,
        samples=16,
        largest_step=0.5,
    )

    amplitudes = [np.abs(first_harmonic(response)).max() for response in curve]
    place = int(np.argmax(amplitudes))
    spacing = 0.5 * 0.04
    assert 0 < place < len(curve) - 1
    assert curve[place].frequency / TURN == pytest.approx(stuck, abs=spacing)


CURVES: dict[str, dict[str, object]] = {
    "A": {"model": "A"},
    "B, GKF": {"model": "B", "friction__law": "gkf"},
    "soft": {"contact__sigma": 3e-7},
    "stiff": {},
}


@pytest.fixture(name="traced", params=CURVES, scope="module")
def _traced(request: pytest.FixtureRequest) -> tuple[Problem, list[PeriodicResponse]]:
    problem = rig_problem(**CURVES[request.param])
    return problem, curve_of(problem)


Traced = tuple[Problem, list[PeriodicResponse]]


def test_every_response_balances_its_forces(traced: Traced) -> None:
    problem, curve = traced
    balance = HarmonicBalance(
        problem, static_equilibrium(problem), FourierBasis(8, 1024)
    )

    for response in curve:
        residual, _ = balance(balance.point(response.coefficients, response.frequency))

        # 1e-8 of preload and drive, both 1 N.
        assert response.residual <= 1e-8
        assert np.abs(residual).max() <= 1.1e-8


def test_a_curve_begins_and_ends_exactly_where_it_should(traced: Traced) -> None:
    _, curve = traced

    assert curve[0].frequency == TURN * 125.0
    assert curve[-1].frequency == TURN * 145.0


def test_the_drive_puts_in_what_friction_and_damping_take_out(traced: Traced) -> None:
    problem, curve = traced

    for response in curve:
        waves, damping = response.coefficients[1:], problem.structure.damping
        orders = np.repeat(np.arange(1, 9), 2)
        lost = np.einsum("k,ki,ij,kj->", orders**2, waves, damping, waves)
        supplied = -np.pi * problem.drive @ waves[0]
        taken = (
            np.pi * response.frequency * lost
            + response.friction_energy
            + response.damping_energy
        )
        # The balance holds up to the residual; measured 6e-9.
        assert taken == pytest.approx(supplied, rel=1e-7)


def test_the_curve_of_falling_friction_has_a_fold() -> None:
    curve = curve_of(rig_problem(model="A", friction__law="gkf"), largest_step=0.1)

    steps = np.diff([response.frequency for response in curve])
    assert steps.min() < 0.0
    assert curve[-1].frequency == TURN * 145.0


def test_a_curve_traced_downwards_passes_the_same_responses() -> None:
    problem = rig_problem(model="B")

    upwards = curve_of(problem)
    downwards = curve_of(problem, lowest=145.0, highest=125.0)

    # To 1e-8 of the loads; at the ends the response follows the load closely.
    for one, other in ((upwards[0], downwards[-1]), (upwards[-1], downwards[0])):
        assert one.frequency == other.frequency
        size = np.abs(one.coefficients[1:]).max()
        np.testing.assert_allclose(
            one.coefficients[1:], other.coefficients[1:], atol=1e-6 * size
        )


def opening() -> Problem:
    """Return a mass that lifts off a linear spring where it vibrates strongly.

    Below, mean and first harmonic are all that moves; beyond, all harmonics do.
    """
    points = contact_points(stiffness=3e3, exponent=1.0, damping=0.0, friction=0)
    return mass_on_contact(
        points, direction=NORMAL, stiffness=20.0, damping=20.0, preload=3.0, drive=1.0
    )


def test_a_contact_that_begins_to_open_excites_the_higher_harmonics() -> None:
    problem = opening()
    balance = HarmonicBalance(
        problem, static_equilibrium(problem), FourierBasis(12, 256)
    )

    curve = curve_of(problem, lowest=2.0, highest=9.0, harmonics=12, samples=256)

    closed = np.array([response.normal_smallest[0] > 0.0 for response in curve])
    assert closed[0]
    assert closed[-1]
    assert not closed.all()
    for response, linear in zip(curve, closed, strict=True):
        overtones = np.abs(response.coefficients[3:]).max()
        size = np.abs(response.coefficients[1:3]).max()
        assert (overtones < 1e-6 * size) == linear
        point = balance.point(response.coefficients, response.frequency)
        assert np.abs(balance(point)[0]).max() <= 1.1e-8


def test_a_response_is_solved_again_with_more_harmonics() -> None:
    problem = rig_problem(model="A")
    rest = static_equilibrium(problem)
    coarse = curve_of(problem, highest=130.0, harmonics=3, samples=128)[-1]

    finer = periodic_response(problem, rest, coarse, harmonics=8, samples=1024)
    again = periodic_response(problem, rest, finer, harmonics=8, samples=1024)

    direct = curve_of(problem, highest=130.0)[-1]
    assert finer.frequency == coarse.frequency
    assert finer.coefficients.shape[0] == 17
    size = np.abs(direct.coefficients[1:]).max()
    np.testing.assert_allclose(
        finer.coefficients[1:], direct.coefficients[1:], atol=1e-6 * size
    )
    assert again.iterations == 0


def test_a_response_that_cannot_be_reached_says_so() -> None:
    problem = rig_problem(model="A")
    known = curve_of(problem, highest=126.0, harmonics=1, samples=64)[0]

    text = r"^the curve does not go on at parameter 785\.398163: .* tolerance 1\.0e-30"
    with pytest.raises(ContinuationError, match=text):
        periodic_response(
            problem,
            static_equilibrium(problem),
            known,
            harmonics=2,
            samples=64,
            tolerance=1e-30,
        )


def test_a_body_that_drifts_says_where_and_how_to_hold_it() -> None:
    problem = rig_problem(rope=None, model="A")
    rest = static_equilibrium(problem)
    along = problem.probes.rows[problem.probes.names.index("friction-element")]
    pushed = dataclasses.replace(problem, preload=problem.preload + 0.02 * along)
    options = CurveOptions(TURN * 125.0, TURN * 130.0, 1, 64)

    text = (
        r"^a body drifts at 785\.398 rad/s: friction has a mean of 0\.01 N "
        r"and nothing holds the body; give it a rope$"
    )
    with pytest.raises(ContinuationError, match=text):
        next(frequency_response(pushed, rest, options))


@pytest.mark.parametrize(("start", "end"), [(0.0, 3.0), (3.0, -1.0), (3.0, 3.0)])
def test_frequencies_that_span_no_range_are_refused(start: float, end: float) -> None:
    text = (
        rf"^frequencies {start:g} and {end:g} rad/s: give two different positive ones$"
    )
    with pytest.raises(ValueError, match=text):
        CurveOptions(start, end)


def phases() -> Array:
    return TURN * np.arange(16) / 16


def test_a_response_in_time_moves_as_its_coefficients_say() -> None:
    response = curve_of(rig_problem(model="B"), highest=126.0, harmonics=3)[-1]

    displacement, velocity = response.at(phases())

    amplitudes = to_complex(response.coefficients)
    turning = np.exp(1j * np.outer(phases(), np.arange(4)))
    rates = 1j * np.arange(4) * response.frequency
    np.testing.assert_allclose(displacement, (turning @ amplitudes).real, atol=1e-15)
    np.testing.assert_allclose(
        velocity, (turning * rates @ amplitudes).real, atol=1e-12
    )
