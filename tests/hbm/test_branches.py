"""Branches of Duffing's oscillator, against time integration by a general solver."""

import functools

import numpy as np
import pytest
import scipy.integrate

from hbm.options import CurveOptions
from hbm.solve import branches, frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from small_problems import cubic_oscillator

DAMPING, DRIVE = 0.2, 6.0
OPTIONS = CurveOptions(1.6, 0.8, error=1e-6)


@functools.cache
def curves() -> tuple[list[PeriodicResponse], list[PeriodicResponse]]:
    """Return the symmetric curve, and what branches off."""
    problem = cubic_oscillator(damping=DAMPING, drive=DRIVE)
    rest = static_equilibrium(problem)
    curve = list(frequency_response(problem, rest, OPTIONS))
    return curve, list(branches(problem, rest, OPTIONS, curve))


def marched(response: PeriodicResponse, periods: int, *, aside: float = 0.0) -> Array:
    """Return displacement and velocity after some periods from a response."""
    displacement, velocity = (part[0, 0] for part in response.at(np.zeros(1)))

    def rate(time: float, state: Array) -> list[float]:
        place, speed = state
        force = DRIVE * np.sin(response.frequency * time)
        return [speed, force - DAMPING * speed - place - place**3]

    end = periods * 2.0 * np.pi / response.frequency
    done = scipy.integrate.solve_ivp(
        rate, (0.0, end), [displacement + aside, velocity], rtol=1e-10, atol=1e-12
    )
    found: Array = done.y[:, -1]
    return found


def away(response: PeriodicResponse, state: Array) -> float:
    """Return how far a state is from the one at the beginning of the period."""
    start = np.array([part[0, 0] for part in response.at(np.zeros(1))])
    return float(np.linalg.norm(state - start))


def test_the_curve_of_two_facing_contacts_is_the_orbit_of_the_cubic_spring() -> None:
    curve, _ = curves()
    stable = [response for response in curve if response.unstable == 0][::3]

    assert len(stable) >= 5
    for response in stable:
        assert away(response, marched(response, 1)) < 1e-4


def test_the_branch_joins_both_branch_points() -> None:
    curve, branch = curves()
    places = sorted(each.frequency for each in curve if each.event == "branch point")

    assert len(places) == 2
    assert [each.event for each in branch].count("branch") == 1
    lowest, highest = (
        extreme(each.frequency for each in branch) for extreme in (min, max)
    )
    assert lowest == pytest.approx(places[0], rel=1e-3)
    assert highest == pytest.approx(places[1], rel=1e-3)


def test_branch_points_are_located_on_the_orbits_that_are_reported() -> None:
    # The curve itself may have half their harmonics.
    problem = cubic_oscillator(damping=DAMPING, drive=DRIVE)
    rest, loose = static_equilibrium(problem), CurveOptions(0.7, 1.6, error=3e-3)
    exact = [each for each in curves()[0] if each.event == "branch point"][::-1]

    curve = list(frequency_response(problem, rest, loose))
    rough = [each for each in curve if each.event == "branch point"]
    begun = [each.event for each in branches(problem, rest, loose, curve)]

    assert len(rough) == len(exact)
    for one, other in zip(rough, exact, strict=True):
        assert one.frequency == pytest.approx(other.frequency, rel=3e-4)
        assert np.abs(one.multipliers - 1.0).min() < 2e-3
    assert begun.count("branch") == 1  # it ends where the other one would begin


def test_orbits_on_the_branch_are_lopsided_and_kept_by_a_march() -> None:
    _, branch = curves()
    lopsided = [each for each in branch if abs(each.coefficients[0, 0]) > 0.05]

    assert len(lopsided) >= 10
    for response in lopsided[::4]:
        assert response.unstable == 0
        assert away(response, marched(response, 1)) < 1e-4
        assert away(response, marched(response, 30, aside=1e-3)) < 1e-4


def test_the_symmetric_orbit_between_the_branch_points_is_left_by_a_march() -> None:
    curve, _ = curves()
    unstable = [each for each in curve if abs(each.multipliers[0]) > 1.2]

    assert len(unstable) >= 10
    for response in unstable[::4]:
        assert response.unstable == 1
        assert away(response, marched(response, 30, aside=1e-3)) > 0.05
