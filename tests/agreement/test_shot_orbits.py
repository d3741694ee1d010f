"""Harmonic balance against shooting: the same orbits and multipliers on every rig."""

import functools

import numpy as np
import pytest

from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_motions.multipliers import floquet_multipliers
from timedomain.record.start import Start, on_orbit
from timedomain.shooting.comparison import MULTIPLIER_FLOOR, compared
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit

TURN = 2.0 * np.pi
GKF: dict[str, object] = {"friction__law": "gkf"}
RIGS: dict[str, dict[str, object]] = {
    "A": {"model": "A"},
    "B": {"model": "B"},
    "stiff": {},
    "soft": {"contact__sigma": 3e-7},
    "A, GKF": {"model": "A", **GKF},
    "B, GKF": {"model": "B", **GKF},
    "stiff, GKF": GKF,
    "soft, GKF": {"contact__sigma": 3e-7, **GKF},
}
SHORT = ("A",)
"""rigs that every run of the tests compares"""
FIXED = 31
"""harmonics of the soft rig, on which a tolerance of 1e-3 asks for 511"""


@functools.cache
def curve(name: str) -> tuple[Problem, tuple[PeriodicResponse, ...]]:
    """Return a rig and what its curve is made of about resonance, without events."""
    problem = rig_problem(**RIGS[name])
    fixed = FIXED if name.startswith("soft") else None
    options = CurveOptions(TURN * 132.0, TURN * 138.0, harmonics=fixed)
    found = frequency_response(problem, static_equilibrium(problem), options)
    return problem, tuple(each for each in found if not each.event)


def near(name: str, *hertz: float) -> list[PeriodicResponse]:
    """Return the responses of a curve nearest to some frequencies."""
    _, responses = curve(name)
    return [
        min(responses, key=lambda each: abs(each.frequency - TURN * place))
        for place in hertz
    ]


@pytest.mark.parametrize(
    "name",
    [
        name if name in SHORT else pytest.param(name, marks=pytest.mark.long)
        for name in RIGS
    ],
)
def test_orbits_agree_within_the_estimates_of_both(name: str) -> None:
    problem, _ = curve(name)

    for response in near(name, 132.0, 133.5, 134.5, 135.0, 136.3, 138.0):
        found = compared(problem, response)
        assert found.as_estimated
        # 31 fixed harmonics admit up to 6 % on the soft rig
        assert found.admitted < (0.2 if name.startswith("soft") else 0.1)
        # so that the estimates are not what agrees
        assert found.difference < 2e-3 or name.startswith("soft")


@pytest.mark.long
def test_an_orbit_beyond_neimark_sacker_is_the_same_and_as_unstable() -> None:
    # Nothing marches there: a pair of multipliers has left the unit circle.
    problem, _ = curve("A, GKF")
    (response,) = near("A, GKF", 134.48)
    assert response.unstable == 2
    assert abs(response.multipliers[0].imag) > 1e-3

    found = compared(problem, response)

    assert found.as_estimated
    assert found.difference < 1e-3
    assert found.found_multiplier > 1.0 + found.multiplier_error
    apart = abs(found.found_multiplier - found.multiplier)
    assert apart < found.multiplier_error + MULTIPLIER_FLOOR / 2.0


@pytest.mark.parametrize("hertz", [133.5, 134.48, 135.3])
def test_multipliers_are_those_of_the_motion_around_the_response(hertz: float) -> None:
    problem, _ = curve("A, GKF")
    (response,) = near("A, GKF", hertz)
    displacement, velocity = response.at(np.zeros(1))

    orbit = periodic_orbit(
        problem, response.frequency, start=Start(displacement[0], velocity[0])
    )
    around = floquet_multipliers(problem, response, steps=1024)

    for own, error in zip(orbit.multipliers[:3], orbit.multiplier_error, strict=False):
        assert np.abs(around.values - own).min() < error + 1e-3


@pytest.mark.parametrize("hertz", [134.5, 135.0])
def test_an_element_that_nothing_holds_moves_as_harmonic_balance_says(
    hertz: float,
) -> None:
    # Without a rope its mean position is free: both leave it where they begin.
    problem = rig_problem(model="A", rope=None)
    (guess,) = near("A", hertz)
    response = periodic_response(
        problem, static_equilibrium(problem), guess, harmonics=127, samples=2048
    )
    displacement, velocity = response.at(np.zeros(1))

    orbit = periodic_orbit(
        problem, response.frequency, start=Start(displacement[0], velocity[0])
    )

    assert orbit.neutral == 1
    assert np.abs(orbit.multipliers[0]) == pytest.approx(1.0, abs=1e-8)
    assert compared(problem, response).difference < orbit.error + 5e-4


@pytest.mark.long
def test_harmonic_balance_comes_closer_to_the_orbit_with_more_harmonics() -> None:
    problem, _ = curve("A")
    (response,) = near("A", 135.0)
    rest = static_equilibrium(problem)
    options = ShootingOptions(2048, 1.0, 4096)
    distances = []
    for harmonics in (1, 8, 31, 127):
        finer = periodic_response(
            problem, rest, response, harmonics=harmonics, samples=16 * (harmonics + 1)
        )
        found = compared(problem, finer, options)
        distances.append(found.difference)

    assert np.all(np.diff(distances) < 0.0)
    assert distances[-1] < 1e-3 * distances[0]


def test_multipliers_by_shooting_err_by_no_more_than_is_told() -> None:
    # two orbits whose multipliers err alike: 1/13 of it was told
    problem, place = rig_problem(), TURN * 135.0256
    options = CurveOptions(TURN * 134.3, TURN * 135.8, stability=False, events=False)
    found = frequency_response(problem, static_equilibrium(problem), options)
    response = min(found, key=lambda each: abs(each.frequency - place))
    start, finest = on_orbit(problem, response), ShootingOptions(steps=2048, most=4096)

    orbit, finer = (
        periodic_orbit(
            problem, response.frequency, start=start, near=response, options=each
        )
        for each in (ShootingOptions(), finest)
    )

    away = np.abs(finer.multipliers - orbit.multipliers[0])
    nearest = int(away.argmin())
    assert orbit.steps < finer.steps
    assert finer.multiplier_error[nearest] < 0.1 * away[nearest]
    assert away[nearest] <= orbit.multiplier_error[0] < 10.0 * away[nearest]
