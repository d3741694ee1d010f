"""Branches of curves; Duffing's against time integration by a general solver."""

import functools
from dataclasses import replace

import numpy as np
import pytest
import scipy.integrate

from hbm.curves.periodic_response import (
    periodic_response,
    settled_response,
    with_multipliers,
)
from hbm.options import CurveOptions
from hbm.solve import branches, frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import between_stops, cubic_oscillator

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


@pytest.mark.long
def test_the_symmetric_orbit_between_the_branch_points_is_left_by_a_march() -> None:
    curve, _ = curves()
    unstable = [each for each in curve if abs(each.multipliers[0]) > 1.2]

    assert len(unstable) >= 10
    for response in unstable[::4]:
        assert response.unstable == 1
        assert away(response, marched(response, 30, aside=1e-3)) > 0.05


def exchanged() -> Problem:
    """Return two alike oscillators, coupled and driven alike."""
    return system(
        names=["a", "b"],
        mass=[1.0, 1.0],
        stiffness=[[1.05, -0.05], [-0.05, 1.05]],
        damping=[[0.02, 0.0], [0.0, 0.02]],
        elements=[
            Element(CubicSpring(cubic=1.0), between=(name, "ground"))
            for name in ("a", "b")
        ],
        drive={"a": 0.05, "b": 0.05},
    )


def shot(response: PeriodicResponse) -> tuple[float, float]:
    """Return how far both oscillators are off after a period, and their difference."""
    start = np.concatenate([part[0] for part in response.at(np.zeros(1))])

    def rate(time: float, state: Array) -> Array:
        place, speed = state[:2], state[2:]
        force = 0.05 * np.sin(response.frequency * time)
        pull = 1.05 * place - 0.05 * place[::-1] + place**3
        return np.concatenate([speed, force - 0.02 * speed - pull])

    end = 2.0 * np.pi / response.frequency
    done = scipy.integrate.solve_ivp(rate, (0.0, end), start, rtol=1e-10, atol=1e-12)
    off = np.abs(done.y[:, -1] - start).max()
    return float(off), float(abs(start[0] - start[1]))


def test_a_branch_on_which_alike_oscillators_move_differently_is_followed() -> None:
    problem, hertz = exchanged(), 2.0 * np.pi
    rest = static_equilibrium(problem)
    options = CurveOptions(0.14 * hertz, 0.3 * hertz, error=1e-4)
    curve = list(frequency_response(problem, rest, options))
    branch = list(branches(problem, rest, options, curve))

    assert [each.event for each in branch].count("branch") == 1
    folds = [each.frequency / hertz for each in branch if each.event == "fold"]
    assert folds == pytest.approx([0.195942, 0.186510, 0.261696], rel=1e-5)
    inner = [each for each in branch if not each.event][5:-5]
    found = [shot(each) for each in inner[::6]]
    assert len(found) > 5
    for off, apart in found:
        assert off < 1e-2 * apart


def test_a_branch_whose_first_step_lands_on_its_mirror_image_goes_on() -> None:
    problem = between_stops()
    rest = static_equilibrium(problem)
    options = CurveOptions(2.0 * np.pi * 6.0, 2.0 * np.pi * 7.5)
    curve = list(frequency_response(problem, rest, options))

    branch = list(branches(problem, rest, options, curve))

    assert [each.event for each in curve].count("branch point") == 1
    assert branch[0].event == "branch"
    assert branch[-1].frequency == options.start
    means = [abs(float(each.coefficients[0, 0])) for each in branch]
    assert means[-1] > 10.0 * means[1] > 0.0
    for each in branch[1:6]:  # with 15 harmonics its foot is elsewhere; measured 2e-3
        finer = periodic_response(problem, rest, each, harmonics=127, samples=4096)
        assert finer.coefficients[0, 0] == pytest.approx(
            each.coefficients[0, 0], rel=4e-3
        )


def test_one_orbit_of_a_branch_stays_on_it() -> None:
    # what the symmetry keeps still was left out, and the symmetric orbit returned
    problem = cubic_oscillator(damping=DAMPING, drive=DRIVE)
    rest = static_equilibrium(problem)
    known = max(curves()[1], key=lambda each: abs(each.coefficients[0, 0]))

    settled = settled_response(problem, rest, known, error=1e-6)
    examined = with_multipliers(
        problem, rest, replace(known, multipliers=np.empty(0, complex)), OPTIONS
    )
    again = periodic_response(problem, rest, known, harmonics=31, samples=512)

    assert abs(known.coefficients[0, 0]) > 0.1
    for found in (settled, again):
        np.testing.assert_allclose(
            found.coefficients[:7], known.coefficients[:7], atol=1e-5
        )
    np.testing.assert_allclose(examined.multipliers, known.multipliers, atol=1e-5)
    assert away(again, marched(again, 1)) < 1e-5
