"""Shooting: closed forms of the linear case, exact derivatives, order, free bodies."""

import dataclasses

import numpy as np
import pytest

from contact_tables import contact_points
from convergence import observed_order
from linear_poles import in_order, poles
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from small_problems import (
    NORMAL,
    TANGENT,
    cantilever,
    cubic_oscillator,
    dwelled,
    from_rest,
    last_harmonic,
    mass_on_contact,
    oscillator,
    rubbing,
)
from timedomain.record.start import Start
from timedomain.shooting.closed_march import ShootingError, closed
from timedomain.shooting.period_map import BLOCK, PeriodMap
from timedomain.shooting.period_sensitivity import sensitivity_of
from timedomain.shooting.periodic_orbit import PeriodicOrbit
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit

TURN = 2.0 * np.pi
MASS, DAMPING, STIFFNESS, DRIVE, FREQUENCY = 2.0, 4.0, 300.0, 1.5, 9.0
ONCE = 1e9
"""an error that the first two orbits meet"""


def linear() -> Problem:
    return oscillator(
        mass=MASS, damping=DAMPING, stiffness=STIFFNESS, preload=6.0, drive=DRIVE
    )


def pressed() -> Problem:
    """Return a mass on Hunt and Crossley's contact that it never leaves."""
    points = contact_points(stiffness=2e3, exponent=1.5, damping=30.0, friction=0)
    return mass_on_contact(
        points, direction=NORMAL, damping=5.0, preload=6.0, drive=1.0
    )


def shot(problem: Problem, frequency: float, steps: int) -> PeriodicOrbit:
    """Return the orbit from ``steps`` and twice as many."""
    options = ShootingOptions(steps, ONCE, 2 * steps)
    return periodic_orbit(problem, frequency, start=from_rest(problem), options=options)


def receptance(rate: complex) -> complex:
    return 1.0 / (STIFFNESS + rate * DAMPING + rate**2 * MASS)


def test_a_linear_orbit_is_that_of_the_trapezoidal_rule_exactly() -> None:
    # It sees the rate d/dt of exp(iωt) as (2i/h) tan(ωh/2).
    problem, steps = linear(), 4 * BLOCK
    carried = PeriodMap.of(problem, FREQUENCY, steps)

    found = closed(carried, carried.state(from_rest(problem)))

    half = np.pi / (FREQUENCY * steps)
    exact = DRIVE * receptance(1j * np.tan(FREQUENCY * half) / half)
    phase = TURN * np.arange(steps + 1) / steps
    expected = 6.0 / STIFFNESS + (exact * np.exp(1j * phase)).imag
    np.testing.assert_allclose(
        found.period.displacement[:, 0], expected, rtol=0.0, atol=1e-12 * abs(exact)
    )
    assert found.iterations == 2
    assert found.gap < 1e-12


def test_multipliers_of_the_march_are_those_of_the_trapezoidal_rule() -> None:
    problem, steps = cantilever(), 6 * BLOCK
    carried = PeriodMap.of(problem, 210.0, steps)

    found = closed(carried, carried.state(from_rest(problem)))

    half = 0.5 * poles(problem.structure) * TURN / 210.0 / steps
    exact = ((1.0 + half) / (1.0 - half)) ** steps
    values = np.linalg.eigvals(found.monodromy()).astype(complex)
    np.testing.assert_allclose(in_order(values), in_order(exact), atol=1e-9)


def test_motions_too_fast_for_the_steps_do_not_seem_to_grow() -> None:
    problem = cantilever(mass_damping=2.0, stiffness_damping=1e-7)
    frequency = TURN * 30.0
    found = periodic_orbit(
        problem,
        frequency,
        start=from_rest(problem),
        options=ShootingOptions(steps=64, most=128, error=ONCE),
    )

    assert found.multiplier_error.max() > 0.1
    assert np.abs(found.multipliers).max() < 1.0
    every = poles(problem.structure)
    slowest = np.exp(every[np.abs(every.imag).argmin()] * TURN / frequency)
    assert np.abs(found.multipliers - slowest).min() < 1e-4


def test_the_extrapolated_linear_orbit_is_the_exact_one() -> None:
    found = shot(linear(), FREQUENCY, 256)

    exact = -1j * DRIVE * receptance(1j * FREQUENCY)
    amplitude = abs(found.coefficients[1, 0] - 1j * found.coefficients[2, 0] - exact)
    assert amplitude < 1e-7 * abs(exact)
    assert found.coefficients[0, 0] == pytest.approx(6.0 / STIFFNESS, rel=1e-12)
    expected = np.exp(poles(linear().structure) * TURN / FREQUENCY)
    away = np.abs(in_order(found.multipliers) - in_order(expected))
    assert away.max() < 1e-6
    assert (away <= found.multiplier_error).all()


def test_harmonics_are_numbered_from_the_mean() -> None:
    found = shot(pressed(), 20.0, 128)

    phase = TURN * np.arange(257) / 256
    orders = np.arange(1, 17)
    angles = np.multiply.outer(phase, orders)
    coarse = found.coefficients - found.moved
    series = coarse[0] + np.cos(angles) @ coarse[1::2] + np.sin(angles) @ coarse[2::2]
    carried = PeriodMap.of(pressed(), 20.0, 256)
    marched = carried.march(carried.state(found.start)).displacement
    np.testing.assert_allclose(series, marched, atol=1e-9)


@pytest.mark.parametrize(
    ("make", "frequency"), [(rubbing, 11.0), (pressed, 20.0), (cubic_oscillator, 1.3)]
)
def test_the_monodromy_is_the_derivative_of_the_march(
    make: type, frequency: float
) -> None:
    problem: Problem = make()
    carried = PeriodMap.of(problem, frequency, 12 * BLOCK)
    found = closed(carried, carried.state(from_rest(problem)))
    # Not on the orbit: there the first and the last tangents are the same.
    state = found.state * 1.1
    monodromy = sensitivity_of(carried, carried.march(state)).monodromy

    step = 1e-6 * np.linalg.norm(state)
    for column, each in enumerate(np.eye(state.size)):
        ends = [after(carried, state + sign * step * each) for sign in (1.0, -1.0)]
        slope = (ends[0] - ends[1]) / (2.0 * step)
        np.testing.assert_allclose(monodromy[:, column], slope, atol=1e-6)


def after(carried: PeriodMap, state: Array) -> Array:
    """Return the state after a period."""
    return carried.end(carried.march(state))


def test_a_march_with_the_same_steps_repeats_the_orbit() -> None:
    problem = rubbing()
    found = shot(problem, 11.0, 320)

    history = dwelled(problem, 11.0, periods=20, steps=found.steps, start=found.start)

    away = np.abs(history.displacement[-20:] - history.displacement[:20]).max()
    assert away < 1e-8 * np.abs(history.displacement).max()


def test_the_extrapolated_orbit_is_that_of_a_long_march_in_the_limit() -> None:
    problem = rubbing()
    found = shot(problem, 11.0, 1024)

    history = dwelled(problem, 11.0, periods=60, steps=8000, start=found.start)

    amplitude = np.abs(last_harmonic(history))
    assert found.amplitude == pytest.approx(amplitude, rel=1e-5)
    assert found.error < 1e-4
    assert found.friction_energy == pytest.approx(
        history.of("friction")[-1] / 60, rel=1e-4
    )


@pytest.mark.parametrize(("make", "frequency"), [(linear, FREQUENCY), (pressed, 20.0)])
def test_the_motion_converges_with_second_and_extrapolated_with_fourth_order(
    make: type, frequency: float
) -> None:
    problem: Problem = make()
    steps = [32, 64, 128, 256]
    reference = shot(problem, frequency, 2048).coefficients[:5]

    orbits = [shot(problem, frequency, each) for each in steps]

    for order, tolerance, motions in (
        (2.0, 0.15, [each.coefficients[:5] - each.moved[:5] for each in orbits]),
        (4.0, 0.4, [each.coefficients[:5] for each in orbits]),
    ):
        errors = [float(np.abs(motion - reference).max()) for motion in motions]
        found = observed_order([1.0 / each for each in steps], errors)
        assert found == pytest.approx(order, abs=tolerance)


@pytest.mark.parametrize("frequency", [9.0, 11.0, 12.0, 14.0])
@pytest.mark.parametrize("threshold", [1e-3, 0.02])
def test_the_error_is_honest_where_friction_turns_over(
    frequency: float, threshold: float
) -> None:
    problem = rubbing(threshold=threshold)
    reference = shot(problem, frequency, 8192).amplitude

    for steps in (256, 512, 1024):
        found = shot(problem, frequency, steps)
        true = np.abs(found.amplitude / reference - 1.0).max()
        assert true <= found.error + 1e-9


def test_steps_are_doubled_until_the_error_is_small() -> None:
    problem = rubbing()
    found = [
        periodic_orbit(
            problem,
            11.0,
            start=from_rest(problem),
            options=ShootingOptions(32, error, 8192),
        )
        for error in (1e-2, 1e-4)
    ]

    assert found[0].error <= 1e-2
    assert found[1].error <= 1e-4
    assert found[1].steps > 2 * found[0].steps
    assert found[1].steps <= 8192


@pytest.mark.parametrize(
    ("error", "most", "taken"),
    [(1e-15, 256, 256), (1e-15, 255, 128), (ONCE, 8192, 64)],
)
def test_no_more_steps_are_taken_than_are_allowed_or_needed(
    error: float, most: int, taken: int
) -> None:
    problem = rubbing()  # none of its orbits meets 1e-15

    orbit = periodic_orbit(
        problem,
        11.0,
        start=from_rest(problem),
        options=ShootingOptions(32, error, most),
    )

    assert orbit.steps == taken  # of the finer march: 32 · 2ⁿ


def test_an_unstable_orbit_is_found_and_known_as_one() -> None:
    # Duffing's oscillator: three motions at 1.6 rad/s, the middle one a saddle.
    problem = cubic_oscillator(drive=0.3, damping=0.1)

    low, middle, high = (
        periodic_orbit(problem, 1.6, start=one_harmonic(size, 1.6))
        for size in duffing_amplitudes()
    )

    for each, size in zip((low, middle, high), duffing_amplitudes(), strict=True):
        assert each.amplitude[0] == pytest.approx(size, rel=0.03)
    assert np.abs(low.multipliers).max() < 1.0
    assert np.abs(high.multipliers).max() < 1.0
    assert middle.multipliers[0].real > 1.001
    assert abs(middle.multipliers[0].imag) < 1e-9
    # Liouville: their product is that of the damping, for all three
    for each in (low, middle, high):
        product = np.prod(each.multipliers).real
        assert product == pytest.approx(np.exp(-0.1 * TURN / 1.6), rel=1e-5)


def duffing_amplitudes() -> Array:
    """Return the amplitudes of one harmonic at 1.6 rad/s, least first (cubic in a²)."""
    frequency = 1.6
    detuned = 1.0 - frequency**2
    roots = np.roots(
        [0.5625, 1.5 * detuned, detuned**2 + (0.1 * frequency) ** 2, -(0.3**2)]
    )
    found: Array = np.sqrt(np.sort(roots[np.abs(roots.imag) < 1e-9].real))
    return found


def one_harmonic(size: float, frequency: float) -> Start:
    """Return the state at phase 0 of x = Im X exp(iωt) of that amplitude."""
    moved = 0.3 / (1.0 - frequency**2 + 0.75 * size**2 + 0.1j * frequency)
    return Start(np.array([moved.imag]), np.array([frequency * moved.real]))


@pytest.mark.parametrize("place", [0.0, 0.7, -2.0])
def test_a_free_block_stays_where_it_was_put(place: float) -> None:
    problem = rubbing(stiffness=0.0, damping=0.0)
    start = Start(np.array([place]), np.array([-0.05]))

    found = periodic_orbit(problem, 11.0, start=start)

    assert found.neutral == 1
    assert np.abs(found.multipliers).max() == pytest.approx(1.0, abs=1e-9)
    # One friction, one mass: every place has the same motion about it.
    held = rubbing(stiffness=1e-5, damping=0.0)
    pinned = periodic_orbit(held, 11.0, start=Start(np.zeros(1), np.array([-0.05])))
    assert pinned.neutral == 0
    assert pinned.coefficients[0, 0] == pytest.approx(0.0, abs=1e-5)
    assert found.amplitude == pytest.approx(pinned.amplitude, rel=1e-5)
    away = abs(found.coefficients[0, 0] - place)
    assert away < 0.2 * max(float(found.amplitude[0]), 1e-3) + 0.02


def test_a_body_that_is_dragged_away_has_no_orbit() -> None:
    points = contact_points(
        stiffness=0.0, damping=0.0, constant_load=True, load=1.0, threshold=0.02
    )
    problem = mass_on_contact(points, direction=TANGENT, preload=0.1, drive=1.0)

    with pytest.raises(ShootingError, match="that nothing holds"):
        periodic_orbit(problem, 11.0, start=Start(np.zeros(1), np.zeros(1)))


def test_without_drive_the_orbit_is_the_equilibrium() -> None:
    problem = dataclasses.replace(pressed(), drive=np.zeros(1))
    rest = from_rest(problem)

    found = periodic_orbit(
        problem, 20.0, start=Start(1.01 * rest.displacement, rest.velocity)
    )

    assert found.coefficients[0] == pytest.approx(rest.displacement, rel=1e-8)
    assert found.amplitude[0] < 1e-9 * rest.displacement[0]


def test_motions_out_of_all_reach_are_an_error_with_its_cause() -> None:
    problem = pressed()

    with pytest.raises(ShootingError, match=r"shooting at 3.183.* Hz with .* steps"):
        periodic_orbit(
            problem,
            20.0,
            start=Start(np.array([1e6]), np.zeros(1)),
            options=ShootingOptions(32, 1e-3, 64),
        )


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((16, 1e-3, 64), "at least 32"),
        ((64, 1e-3, 100), "at least 128"),
        ((64, 0.0, 128), "positive finite"),
        ((64, np.nan, 128), "positive finite"),
    ],
)
def test_options_that_cannot_be_met_are_refused(
    arguments: tuple[int, float, int], words: str
) -> None:
    with pytest.raises(ValueError, match=words):
        ShootingOptions(*arguments)


@pytest.mark.parametrize("frequency", [0.0, -1.0, np.inf, np.nan])
def test_a_frequency_must_be_positive_and_finite(frequency: float) -> None:
    with pytest.raises(ValueError, match="positive finite"):
        periodic_orbit(linear(), frequency, start=from_rest(linear()))


def test_steps_are_rounded_up_to_whole_blocks() -> None:
    assert PeriodMap.of(linear(), FREQUENCY, 3 * BLOCK - 1).steps == 3 * BLOCK
