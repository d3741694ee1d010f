"""Equivalent springs and dampers: closed forms, energy, limits, free decay."""

import functools

import numpy as np
import pytest
import scipy.linalg

from hbm.forces.equivalent import equivalent_contact, free_structure, stuck_structure
from hbm.one_harmonic import one_harmonic_response
from hbm.structure.poles import damping_ratios, frequencies, poles
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import dwelled, sliding_block, swinging
from sparse_problems import dense, net
from timedomain.record.start import Start

TURN = 2.0 * np.pi
RANGE = (TURN * 125.0, TURN * 145.0)
RIGS: dict[str, dict[str, object]] = {
    "A": {"model": "A"},
    "A, GKF": {"model": "A", "friction__law": "gkf"},
    "B": {"model": "B"},
    "soft": {"contact__sigma": 3e-7},
    "jammed": {},
}


def coulomb_damping(load: float, threshold: float, speed: float) -> float:
    """Return friction's first harmonic over that of a velocity speed · cos ωt."""
    stick = np.arcsin(min(threshold / speed, 1.0))
    viscous = (stick - np.sin(stick) * np.cos(stick)) / (2.0 * threshold)
    return 4.0 / np.pi * load * float(viscous + np.cos(stick) / speed)


@functools.cache
def rig_response(name: str) -> tuple[Problem, PeriodicResponse]:
    """Return a rig and its one-harmonic response at resonance."""
    problem = rig_problem(**RIGS[name])
    rest = static_equilibrium(problem)
    return problem, one_harmonic_response(problem, rest, RANGE)


@pytest.mark.parametrize("speed", [0.01, 0.1, 0.11, 0.3, 5.0])
def test_coulomb_friction_has_the_damping_of_the_closed_form(speed: float) -> None:
    block = sliding_block(load=1.7, dynamic=0.3, threshold=0.1)
    expected = coulomb_damping(0.51, 0.1, speed)

    errors = []
    for samples in (512, 2048):
        found = equivalent_contact(block, swinging(speed / 40.0, 40.0, samples))
        errors.append(abs(found.damping[1] / expected - 1.0))
        assert abs(found.stiffness[1]) < 1e-9 * 40.0 * expected

    assert errors[1] < 2e-6
    # of second order where there are transitions
    assert errors[1] < errors[0] / 8.0 or errors[0] < 1e-12


def test_sharp_friction_has_four_mu_n_over_pi_omega_a() -> None:
    block = sliding_block(load=1.7, dynamic=0.3, threshold=1e-9)

    found = equivalent_contact(block, swinging(0.002, 40.0, 2048))

    expected = 4.0 * 0.51 / (np.pi * 40.0 * 0.002)
    assert found.damping[1] == pytest.approx(expected, rel=2e-6)


def test_across_the_sliding_friction_is_a_damper_of_its_mean_tangent() -> None:
    # µN / max(|v|, V_lim), averaged over v = V cos ωt
    speed, threshold = 5.0, 0.1
    block = sliding_block(load=1.7, dynamic=0.3, threshold=threshold)

    found = equivalent_contact(block, swinging(speed / 40.0, 40.0, 4096))

    stick = np.arcsin(threshold / speed)
    mean = 2.0 / np.pi * (stick / threshold - np.log(np.tan(stick / 2.0)) / speed)
    assert found.damping[2] == pytest.approx(0.51 * mean, rel=1e-4)
    np.testing.assert_array_equal(found.stiffness[[0, 2]], 0.0)


@pytest.mark.parametrize(
    "name",
    ["A", "A, GKF", "B", "jammed", pytest.param("soft", marks=pytest.mark.long)],
)
def test_dampers_take_out_what_friction_and_normal_damping_do(name: str) -> None:
    problem, response = rig_response(name)

    found = equivalent_contact(problem, response)

    rows = problem.interface.displacement
    squares = ((response.coefficients[1:3] @ rows.T) ** 2).sum(axis=0)
    work = np.pi * response.frequency * found.damping * squares
    friction, normal = work.reshape(-1, 3)[:, 1:].sum(), work[::3].sum()
    assert friction == pytest.approx(response.friction_energy, rel=1e-5)
    small = 1e-6 * response.friction_energy
    assert normal == pytest.approx(response.damping_energy, rel=1e-5, abs=small)


@pytest.mark.parametrize("name", RIGS)
def test_the_linear_structure_answers_the_drive_alike(name: str) -> None:
    problem, response = rig_response(name)

    linear = equivalent_contact(problem, response).joined(problem)

    rate = 1j * response.frequency
    matrix = rate**2 * linear.mass + rate * linear.damping + linear.stiffness
    answer = np.linalg.solve(matrix, -1j * problem.drive)
    expected = response.coefficients[1] - 1j * response.coefficients[2]
    size = np.abs(expected).max()
    np.testing.assert_allclose(answer, expected, rtol=0.0, atol=1e-6 * size)


@pytest.mark.parametrize("model", ["A", "B", "full"])
def test_without_friction_the_poles_are_those_of_the_free_structure(model: str) -> None:
    problem = rig_problem(
        model=model, friction__mu_dynamic=0.0, excitation__force="1 mN"
    )
    rest = static_equilibrium(problem)
    response = one_harmonic_response(problem, rest, RANGE)

    found = poles(equivalent_contact(problem, response).joined(problem)).values
    expected = poles(free_structure(problem, rest)).values

    near = (frequencies(expected) > 50.0) & (frequencies(expected) < 500.0)
    assert near.sum() > 3
    for value in expected[near]:
        assert np.abs(found - value).min() < 1e-4 * abs(value)


def test_much_friction_ties_the_faces() -> None:
    apart = []
    for threshold in ("1 mm/s", "0.1 mm/s"):
        problem = rig_problem(
            model="A",
            friction__mu_dynamic=50.0,
            friction__threshold_velocity=threshold,
        )
        rest = static_equilibrium(problem)
        response = one_harmonic_response(problem, rest, RANGE)
        found = poles(equivalent_contact(problem, response).joined(problem)).values
        stuck = stuck_structure(problem, rest)
        assert stuck is not None
        expected = poles(stuck).values
        (value,) = expected[(expected.imag > RANGE[0]) & (expected.imag < RANGE[1])]
        apart.append(float(np.abs(found - value).min()))

    # what is left is the creep, proportional to the threshold velocity
    assert apart[0] < 1e-5 * RANGE[0]
    assert apart[1] == pytest.approx(0.1 * apart[0], rel=0.01)


def test_stuck_faces_move_as_one_on_very_stiff_springs() -> None:
    problem = rig_problem(model="B")
    rest, rows = static_equilibrium(problem), problem.interface.displacement
    stuck = stuck_structure(problem, rest)
    assert stuck is not None
    found = poles(stuck).values
    whole = free_structure(problem, rest)
    tangents = rows[np.arange(len(rows)) % 3 > 0]

    apart = []
    for spring in (1e9, 1e10):
        held = whole.stiffness + spring * tangents.T @ tangents
        squares = scipy.linalg.eigh(held, whole.mass, eigvals_only=True)
        apart.append(np.sort(np.abs(found))[:4] / np.sqrt(squares[:4]) - 1.0)

    # what the springs yield is inverse to their stiffness
    assert np.abs(apart[1]).max() < 1e-3
    assert apart[1].max() == pytest.approx(0.1 * apart[0].max(), rel=0.05)


def test_without_friction_law_nothing_is_tied() -> None:
    problem = rig_problem(model="B", friction__law="none")
    rest = static_equilibrium(problem)

    stuck = stuck_structure(problem, rest)

    assert stuck is not None
    assert stuck.dofs == problem.structure.dofs


def test_free_decay_in_time_is_that_of_the_pole() -> None:
    # Coulomb friction takes 4 µN / k off the amplitude in each period.
    problem = sliding_block(
        stiffness=300.0, load=1.0, dynamic=0.003, threshold=1e-6, drive=0.0
    )
    natural, amplitude = np.sqrt(150.0), 0.05
    response = swinging(amplitude, natural, 1024)
    (value,) = poles(equivalent_contact(problem, response).joined(problem)).values
    period = TURN / value.imag
    start = Start(np.array([amplitude]), np.zeros(1))

    history = dwelled(problem, value.imag, periods=1, steps=8000, start=start)

    left = history.displacement[-1, 0]
    assert period == pytest.approx(TURN / natural, rel=1e-6)
    assert left == pytest.approx(amplitude - 4.0 * 0.003 / 300.0, abs=1e-8)
    # the pole decays exponentially: equal to first order in the ratio of damping
    lost, ratio = amplitude - left, damping_ratios(np.array([value]))[0]
    assert lost == pytest.approx(
        amplitude * (1.0 - np.exp(value.real * period)), rel=2.0 * np.pi * ratio
    )


def test_a_sparse_structure_has_the_springs_and_dampers_of_a_dense_one() -> None:
    sparse = net(4, 5)
    found = []
    for problem in (sparse, dense(sparse)):
        rest = static_equilibrium(problem)
        response = one_harmonic_response(problem, rest, (300.0, 400.0), 350.0)
        contact = equivalent_contact(problem, response)
        found.append(
            (
                contact.stiffness[1],
                contact.damping[1],
                *response.amplitudes(problem.probes.rows),
            )
        )

    np.testing.assert_allclose(found[0][1:], found[1][1:], rtol=1e-6)
    assert found[0][0] == pytest.approx(found[1][0], abs=1e-3 * 350.0 * found[1][1])


def test_nothing_is_left_of_a_mass_that_friction_ties() -> None:
    problem = sliding_block(stiffness=100.0)

    assert stuck_structure(problem, static_equilibrium(problem)) is None
