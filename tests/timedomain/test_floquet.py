"""Floquet multipliers: closed forms, Mathieu's boundaries, Liouville's product."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import mathieu_a

from contact_tables import contact_points
from convergence import observed_order
from linear_poles import in_order, poles
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import FRICTIONLESS
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from small_motions.multipliers import floquet_multipliers, monodromy
from small_problems import (
    NORMAL,
    cantilever,
    mass_on_contact,
    oscillator,
    prescribed,
    sliding_block,
)
from timedomain.shooting.floquet import Multipliers

TURN = 2.0 * np.pi
FREQUENCY, MASS = 3.0, 2.0
STRENGTH = 0.4
"""q of Mathieu's equation"""


def orbit(*coefficients: float, frequency: float = FREQUENCY) -> PeriodicResponse:
    """Return a prescribed motion of one degree of freedom; what drives it is free."""
    return prescribed(frequency, np.array(coefficients)[:, None])


@pytest.mark.parametrize("make", [oscillator, cantilever])
def test_without_contact_multipliers_are_exponentials(make: type) -> None:
    problem: Problem = make()
    response = prescribed(210.0, np.zeros((3, problem.structure.dofs)))

    found = floquet_multipliers(problem, response, steps=16)

    exact = np.exp(poles(problem.structure) * TURN / 210.0)
    np.testing.assert_allclose(in_order(found.values), in_order(exact), atol=1e-9)
    assert np.all(np.diff(np.abs(found.values)) < 1e-12)


def parametric(boundary: int) -> tuple[Problem, PeriodicResponse]:
    """Return Mathieu's equation on a boundary of its stability.

    On a quadratic contact without damping the stiffness 2 K (δ₀ + δ₁ cos ωt) varies
    with the orbit; in t' = ωt/2, a = 8 K δ₀/(m ω²) and −2 q = 8 K δ₁/(m ω²), with
    q = :data:`STRENGTH`.
    """
    points = contact_points(damping=0.0, friction=FRICTIONLESS, stiffness=5.0)
    unit = 8.0 * 5.0 / (MASS * FREQUENCY**2)
    mean = float(mathieu_a(boundary, STRENGTH)) / unit
    problem = mass_on_contact(points, direction=NORMAL, mass=MASS)
    return problem, orbit(mean, -2.0 * STRENGTH / unit, 0.0)


@pytest.mark.parametrize(("boundary", "trace"), [(1, -2.0), (2, 2.0), (3, -2.0)])
def test_mathieu_boundaries_have_their_trace(boundary: int, trace: float) -> None:
    problem, response = parametric(boundary)

    found = monodromy(problem, response, steps=2000)

    assert np.trace(found) == pytest.approx(trace, abs=1e-5)
    assert np.linalg.det(found) == pytest.approx(1.0, abs=1e-9)


def test_the_monodromy_converges_with_second_order() -> None:
    problem, response = parametric(1)
    steps = [96, 192, 384, 768]

    errors = [
        abs(np.trace(monodromy(problem, response, steps=each)) + 2.0) for each in steps
    ]

    order = observed_order([1.0 / each for each in steps], errors)
    assert order == pytest.approx(2.0, abs=0.15)


def test_extrapolated_multipliers_converge_with_fourth_order() -> None:
    problem, response = parametric(1)
    steps = [96, 192, 384, 768]

    errors = [
        abs(floquet_multipliers(problem, response, steps=each).values.sum() + 2.0)
        for each in steps
    ]

    order = observed_order([1.0 / each for each in steps], errors)
    assert order == pytest.approx(4.0, abs=0.3)


def test_multipliers_err_by_a_quarter_of_that_with_half_the_steps_at_least() -> None:
    known = Multipliers(np.array([1.2, 0.5]), np.array([1e-6, 1e-3]))
    before = Multipliers(np.array([0.52, 1.19]), np.array([2e-3, 4e-2]))

    told = known.after(before)

    np.testing.assert_allclose(told.error, [1e-2, 1e-3])
    np.testing.assert_array_equal(told.values, known.values)


@pytest.mark.parametrize(
    "mean", [pytest.param(0.5, id="in contact"), pytest.param(0.1, id="separating")]
)
def test_the_product_of_multipliers_is_that_of_liouville(mean: float) -> None:
    points = contact_points(exponent=1.5, stiffness=200.0, damping=3.0)
    problem = mass_on_contact(points, direction=NORMAL, mass=MASS, damping=0.3)
    response = orbit(mean, 0.0, 0.3)

    found = floquet_multipliers(problem, response, steps=1000)

    phase = TURN * (np.arange(200_000) + 0.5) / 200_000
    rate = 0.3 + 3.0 * np.sqrt(np.maximum(mean + 0.3 * np.sin(phase), 0.0))
    exact = np.exp(-rate.mean() / MASS * TURN / FREQUENCY)
    assert np.prod(found.values).real == pytest.approx(exact, rel=1e-6)
    assert found.error.max() < 1e-3


def exact_monodromy(elastic: float, viscous: float, mean: float, moved: float) -> Array:
    """Integrate small motions of a mass on K δ^1.5 + C √δ δ̇, tangents written out."""

    def slope(time: float, state: Array) -> Array:
        depth = mean + moved * np.sin(FREQUENCY * time)
        rate = FREQUENCY * moved * np.cos(FREQUENCY * time)
        stiffness = 1.5 * elastic * np.sqrt(depth)
        stiffness += 0.5 * viscous * rate / np.sqrt(depth)
        small, moving = state.reshape(2, 2)
        force = stiffness * small + viscous * np.sqrt(depth) * moving
        return np.concatenate([moving, -force / MASS])

    span = (0.0, TURN / FREQUENCY)
    found = solve_ivp(
        slope, span, np.eye(2).ravel(), method="DOP853", rtol=1e-12, atol=1e-14
    )
    last: Array = found.y[:, -1].reshape(2, 2)
    return last


def test_varying_stiffness_and_damping_are_those_of_a_general_integrator() -> None:
    elastic, viscous, mean, moved = 200.0, 12.0, 0.5, 0.4
    points = contact_points(
        exponent=1.5, stiffness=elastic, damping=viscous, friction=FRICTIONLESS
    )
    problem = mass_on_contact(points, direction=NORMAL, mass=MASS)
    response = orbit(mean, 0.0, moved)
    exact = exact_monodromy(elastic, viscous, mean, moved)

    found = monodromy(problem, response, steps=4000)
    multipliers = floquet_multipliers(problem, response, steps=4000).values

    accepted = 2e-7 * np.abs(exact).max()
    np.testing.assert_allclose(found, exact, rtol=0.0, atol=accepted)
    eigenvalues = np.linalg.eigvals(exact).astype(complex)
    away = np.abs(in_order(multipliers) - in_order(eigenvalues))
    assert away.max() < 1e-9


@pytest.mark.parametrize("threshold", [0.1, 1e-2, 1e-4])
@pytest.mark.parametrize("steps", [4, 64])
def test_turns_of_friction_are_not_missed(threshold: float, steps: int) -> None:
    # Sticking lasts for 4 asin(V_lim / V) of phase, down to 1.3e-4 of the period.
    load, friction, speed = 1.7, 0.3, 0.9
    problem = sliding_block(mass=MASS, load=load, dynamic=friction, threshold=threshold)
    response = orbit(0.0, 0.2, speed / FREQUENCY)
    fastest = np.hypot(0.2 * FREQUENCY, speed)

    found = floquet_multipliers(problem, response, steps=steps)

    sticking = 4.0 * np.arcsin(threshold / fastest) / FREQUENCY
    exact = np.exp(-friction * load / threshold * sticking / MASS)
    np.testing.assert_allclose(found.values, [1.0, exact], rtol=1e-9)
