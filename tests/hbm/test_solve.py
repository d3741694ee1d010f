"""Frequency response curves: their balances, ends, folds and errors."""

from dataclasses import replace

import numpy as np
import pytest

from contact_tables import contact_points
from hbm.balance.relative_problem import relative_problem
from hbm.balance.residual import HarmonicBalance
from hbm.curves.periodic_response import periodic_response, settled_response
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis, to_complex
from hbm.modes.mode_options import ModeOptions
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.structures.structure import Structure
from rigs import rig_problem
from small_problems import NORMAL, mass_on_contact

TURN = 2.0 * np.pi


def curve_of(
    problem: Problem,
    *,
    lowest: float = 125.0,
    highest: float = 145.0,
    harmonics: int = 8,
    samples: int = 1024,
    largest_step: float = 0.25,
) -> list[PeriodicResponse]:
    """Return the responses from one frequency [Hz] to another."""
    options = CurveOptions(
        TURN * lowest,
        TURN * highest,
        harmonics=harmonics,
        samples=samples,
        tolerance=1e-8,
        largest_step=largest_step,
    )
    return list(frequency_response(problem, static_equilibrium(problem), options))


def whole_balance(
    problem: Problem, fourier: FourierBasis
) -> tuple[HarmonicBalance, Array]:
    """Return the balance of all coefficients, and the map from motions to y."""
    relative = relative_problem(problem, static_equilibrium(problem))
    return HarmonicBalance(relative, fourier), relative.selection


CURVES: dict[str, dict[str, object]] = {
    "A": {"model": "A"},
    "B, GKF": {"model": "B", "friction__law": "gkf"},
    "soft": {"contact__sigma": 3e-7},
    "stiff": {},
}


@pytest.fixture(
    name="traced",
    params=["A", "B, GKF", "stiff", pytest.param("soft", marks=pytest.mark.long)],
    scope="module",
)
def _traced(request: pytest.FixtureRequest) -> tuple[Problem, list[PeriodicResponse]]:
    problem = rig_problem(**CURVES[request.param])
    return problem, curve_of(problem)


Traced = tuple[Problem, list[PeriodicResponse]]


def test_every_response_balances_its_forces(traced: Traced) -> None:
    problem, curve = traced
    balance, selection = whole_balance(problem, FourierBasis(8, 1024))

    for response in curve:
        relative = response.coefficients @ selection.T
        residual, _ = balance(balance.point(relative, response.frequency))

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


@pytest.mark.long
def test_the_curve_of_falling_friction_has_a_fold() -> None:
    curve = curve_of(rig_problem(model="A", friction__law="gkf"), largest_step=0.1)

    steps = np.diff([response.frequency for response in curve])
    assert steps.min() < 0.0
    assert curve[-1].frequency == TURN * 145.0


@pytest.mark.long
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
    balance, selection = whole_balance(problem, FourierBasis(12, 256))

    curve = curve_of(problem, lowest=2.0, highest=9.0, harmonics=12, samples=256)

    closed = np.array([response.normal_smallest[0] > 0.0 for response in curve])
    assert closed[0]
    assert closed[-1]
    assert not closed.all()
    for response, linear in zip(curve, closed, strict=True):
        overtones = np.abs(response.coefficients[3:]).max()
        size = np.abs(response.coefficients[1:3]).max()
        assert (overtones < 1e-6 * size) == linear
        relative = response.coefficients @ selection.T
        point = balance.point(relative, response.frequency)
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


def test_a_response_settles_to_the_error_asked_for() -> None:
    problem = rig_problem(model="A")
    rest = static_equilibrium(problem)
    options = CurveOptions(TURN * 134.0, TURN * 135.0, error=1e-2, stability=False)
    guess = next(frequency_response(problem, rest, options))
    exact = periodic_response(problem, rest, guess, harmonics=511, samples=16384)

    found = [
        settled_response(problem, rest, guess, error=error) for error in (1e-2, 1e-4)
    ]

    seen = [each.seen(problem.probes.rows)[1:3, 0] for each in (*found, exact)]
    loose, tight, right = (float(np.hypot(*each)) for each in seen)
    assert found[0].harmonics < found[1].harmonics
    assert found[1].error <= 1e-4
    assert abs(loose / right - 1.0) < 1e-2
    assert abs(tight / right - 1.0) < 1e-4


def test_a_response_that_cannot_be_reached_says_so() -> None:
    problem = rig_problem(model="A")
    known = curve_of(problem, highest=126.0, harmonics=1, samples=64)[0]

    text = r"^no response is found at 125 Hz: .*residual"
    with pytest.raises(ContinuationError, match=text):
        periodic_response(
            problem,
            static_equilibrium(problem),
            replace(known, coefficients=np.full_like(known.coefficients, np.nan)),
            harmonics=2,
            samples=64,
        )


def walker(stiffness: float) -> Problem:
    """Return a mass that is pressed more strongly when it slides one way.

    Across, it vibrates at resonance a quarter of a period behind its drive, as its
    sliding velocity does: friction has a mean of about µ ΔN 2/π.
    """
    contact = Interface(
        contact_points(
            stiffness=200.0, exponent=1.0, damping=0.0, dynamic=0.3, threshold=1e-3
        ),
        np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
        ("foot",),
    )
    structure = Structure(
        2.0 * np.eye(2),
        np.diag([20.0, 0.0]),
        np.diag([0.0, stiffness]),
        ("across", "along"),
    )
    return Problem(
        structure,
        contact,
        preload=np.array([4.0, 0.0]),
        drive=np.array([1.0, 3.0]),
        probes=Probes(("along",), np.array([[0.0, 1.0]])),
    )


def test_a_body_that_drifts_says_where_and_how_to_hold_it() -> None:
    problem = walker(0.0)
    options = CurveOptions(10.0, 12.0, harmonics=5)

    text = (
        r"^a body drifts at 1\.59155 Hz: friction has a mean of 0\.1[0-9] N "
        r"and nothing holds the body; hold it by a spring$"
    )
    with pytest.raises(ContinuationError, match=text):
        next(frequency_response(problem, static_equilibrium(problem), options))


def test_a_body_on_a_rope_is_pulled_as_far_as_its_mean_friction_needs() -> None:
    problem, rope = walker(20.0), 20.0
    options = CurveOptions(10.0, 12.0, error=1e-4)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    phase = TURN * (np.arange(20_000) + 0.5) / 20_000
    displacement, velocity = first.at(phase)
    pressed = 200.0 * displacement[:, 0]
    assert pressed.min() > 0.0
    friction = 0.3 * pressed * np.clip(velocity[:, 1] / 1e-3, -1.0, 1.0)
    # What is left is the error of truncation; measured 2e-4.
    mean = rope * first.coefficients[0, 1]
    assert mean == pytest.approx(-friction.mean(), rel=2e-3)
    assert abs(mean) > 0.1


@pytest.mark.parametrize("end", [3.0, np.inf, np.nan])
def test_what_spans_no_range_is_refused(end: float) -> None:
    text = rf"^from 3 to {end:g}: give two different finite values$"
    with pytest.raises(ValueError, match=text):
        CurveOptions(3.0, end)


@pytest.mark.parametrize("harmonics", [0, -1])
def test_fewer_than_one_harmonic_are_refused(harmonics: int) -> None:
    text = rf"^harmonics {harmonics}: give at least 1, or None"
    with pytest.raises(ValueError, match=text):
        CurveOptions(3.0, 4.0, harmonics=harmonics)
    with pytest.raises(ValueError, match=text):
        ModeOptions(1e-5, 1e-4, harmonics=harmonics)


@pytest.mark.parametrize(("start", "end"), [(0.0, 3.0), (3.0, -1.0)])
def test_frequencies_that_are_not_positive_are_refused(
    start: float, end: float
) -> None:
    problem = walker(20.0)
    curve = frequency_response(
        problem, static_equilibrium(problem), CurveOptions(start, end)
    )
    text = rf"^frequencies {start:g} and {end:g} rad/s: give positive ones$"
    with pytest.raises(ValueError, match=text):
        next(curve)


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


def steep() -> Problem:
    """Return the rig with friction that falls to a tenth within millimetres a second.

    What few harmonics take for an orbit with sticking contacts has no neighbour with
    more: friction cannot hold it.
    """
    return rig_problem(
        model="B",
        friction__law="gkf",
        friction__mu_dynamic=0.1,
        friction__mu_static=1.0,
        friction__stribeck_velocity=1e-3,
    )


def test_an_orbit_that_more_harmonics_do_not_have_is_not_taken_for_one() -> None:
    problem = steep()
    rest = static_equilibrium(problem)
    fixed = CurveOptions(TURN * 133.9528, TURN * 135.0, harmonics=1, samples=32)

    response = next(iter(frequency_response(problem, rest, fixed)))

    assert response.error == np.inf
    with pytest.raises(ContinuationError):
        periodic_response(problem, rest, response, harmonics=63, samples=1024)
