"""All steps of a period at once: a saddle's closed form, the march's own orbit."""

import numpy as np
import pytest

from contact_tables import contact_points
from convergence import observed_order
from hbm.curves.periodic_response import periodic_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import TWO_SIDED
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from small_problems import (
    NORMAL,
    cubic_oscillator,
    from_rest,
    mass_on_contact,
    prescribed,
    rubbing,
)
from timedomain.record.start import on_orbit
from timedomain.shooting.closed_march import ShootingError, closed
from timedomain.shooting.comparison import compared
from timedomain.shooting.cyclic_system import cyclic_solution
from timedomain.shooting.period_map import PeriodMap
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit
from timedomain.shooting.whole_change import whole_change
from timedomain.shooting.whole_orbit import whole_orbit

MASS, DAMPING, DRIVE, FREQUENCY = 2.0, 4.0, 1.5, 9.0
REPELLING = 2e4
"""stiffness that pushes a mass away [N/m]: it goes by e⁷⁰ in a period"""


def test_a_chain_is_solved_however_much_its_links_grow() -> None:
    numbers = np.random.default_rng(3)
    maps = 1e6 * numbers.normal(size=(50, 4, 4))
    maps[:, 2:] *= 1e-12  # some directions grow, others vanish
    sources = numbers.normal(size=(50, 4))

    found = cyclic_solution(maps, sources)

    after = np.einsum("lij,lj->li", maps, found) + sources
    size = np.abs(maps).max() * np.abs(found).max()
    assert np.abs(np.roll(found, -1, axis=0) - after).max() < 1e-12 * size


def repelled() -> Problem:
    points = contact_points(
        normal=TWO_SIDED, stiffness=-REPELLING, exponent=1.0, damping=0.0, friction=0
    )
    return mass_on_contact(
        points, direction=NORMAL, mass=MASS, damping=DAMPING, drive=DRIVE
    )


def amplitude(motion: Array) -> float:
    """Return the first harmonic of a period, its beginning repeated at its end."""
    return float(2.0 * np.abs(np.fft.rfft(motion[:-1])[1]) / (len(motion) - 1))


def test_the_orbit_of_a_saddle_converges_to_its_closed_form() -> None:
    problem, steps = repelled(), (256, 512, 1024)
    receptance = 1.0 / (-REPELLING + 1j * FREQUENCY * DAMPING - FREQUENCY**2 * MASS)
    exact = DRIVE * abs(receptance)

    found = [
        whole_orbit(PeriodMap.of(problem, FREQUENCY, count), prescribed(FREQUENCY))
        for count in steps
    ]

    errors = [
        abs(amplitude(each.period.displacement[:, 0]) / exact - 1.0) for each in found
    ]
    assert errors[-1] < 1e-6
    assert observed_order([1.0 / count for count in steps], errors) == pytest.approx(
        2.0, abs=0.1
    )


def test_the_multiplier_of_a_saddle_is_that_of_its_pole() -> None:
    problem = repelled()
    rate = (-DAMPING + np.sqrt(DAMPING**2 + 4.0 * MASS * REPELLING)) / (2.0 * MASS)
    options = ShootingOptions(steps=1024, error=1e9, most=2048)

    with pytest.raises(ShootingError):
        periodic_orbit(problem, FREQUENCY, start=from_rest(problem), options=options)
    orbit = periodic_orbit(
        problem,
        FREQUENCY,
        start=from_rest(problem),
        options=options,
        near=prescribed(FREQUENCY),
    )

    growth = np.log(np.abs(orbit.multipliers[0]))
    assert growth == pytest.approx(rate * 2.0 * np.pi / FREQUENCY, rel=2e-3)


def test_it_is_the_orbit_that_a_march_closes() -> None:
    problem = rubbing()
    carried = PeriodMap.of(problem, FREQUENCY, 256)

    marched = closed(carried, carried.state(from_rest(problem)))
    whole = whole_orbit(carried, prescribed(FREQUENCY))

    assert whole.state == pytest.approx(marched.state, rel=1e-7)
    motions = (each.period.displacement for each in (whole, marched))
    assert np.ptp(np.subtract(*motions)) < 1e-8 * np.ptp(whole.period.displacement)
    assert whole.period.friction == pytest.approx(marched.period.friction, rel=1e-7)
    assert np.abs(whole.monodromy() - marched.monodromy()).max() < 1e-6


def resonant(problem: Problem, frequency: float, *loud: float) -> PeriodicResponse:
    """Return what harmonic balance finds from a first harmonic."""
    first = np.array([0.0, *loud])[:, None]
    guess = prescribed(frequency, first)
    rest = static_equilibrium(problem)
    return periodic_response(problem, rest, guess, harmonics=15, samples=256)


def test_of_three_orbits_it_is_the_one_near_by() -> None:
    problem, frequency = cubic_oscillator(drive=0.3, damping=0.1), 1.5
    quiet = resonant(problem, frequency, 0.0, -0.2)
    loud = resonant(problem, frequency, -0.8, 1.0)
    sizes = [np.hypot(*each.coefficients[1:3, 0]) for each in (quiet, loud)]
    start = on_orbit(problem, loud)

    marched = periodic_orbit(problem, frequency, start=start)
    near = periodic_orbit(problem, frequency, start=start, near=quiet)

    assert sizes[1] > 3.0 * sizes[0]
    assert marched.amplitude[0] == pytest.approx(sizes[1], rel=1e-4)
    assert near.amplitude[0] == pytest.approx(sizes[0], rel=1e-4)


def test_where_no_orbit_is_near_by_it_is_the_one_that_there_is() -> None:
    problem = rubbing()
    first = np.array([[0.0], [0.0], [-1.0]])
    far = prescribed(FREQUENCY, first)

    orbit = periodic_orbit(problem, FREQUENCY, start=from_rest(problem), near=far)

    alone = periodic_orbit(problem, FREQUENCY, start=from_rest(problem))
    assert orbit.amplitude == pytest.approx(alone.amplitude, rel=1e-6)


def test_harmonic_balance_finds_the_same_orbit_on_a_hill() -> None:
    # two springs of third degree bend the hill where the mass goes
    problem = cubic_oscillator(
        cubic=4e11, damping=DAMPING, stiffness=-REPELLING, drive=DRIVE
    )
    first = np.array([[0.0], [0.0], [-DRIVE / REPELLING]])
    guess = prescribed(FREQUENCY, first)
    rest = static_equilibrium(problem)
    balanced = periodic_response(problem, rest, guess, harmonics=15, samples=256)

    found = compared(problem, balanced)

    assert found.difference < 1e-6
    assert found.predicted[0] > 1.1 * DRIVE / REPELLING
    assert found.found_multiplier > 1e20


def test_without_contacts_it_is_that_of_contacts_that_do_nothing() -> None:
    draw = np.random.default_rng(2)
    free, left = 0.5 * draw.normal(size=(4, 4)), draw.normal(size=(64, 4))

    none, idle = (
        whole_change(
            free,
            np.zeros((4, rank)),
            np.zeros((2 * rank, 4)),
            np.zeros((64, rank, 2 * rank)),
            left,
        )
        for rank in (0, 1)
    )

    np.testing.assert_allclose(none, idle, rtol=1e-12)
