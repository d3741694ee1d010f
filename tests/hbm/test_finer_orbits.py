"""Orbits with more harmonics than a curve has."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hbm.continuation.arc import upright
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.newton import correct
from hbm.continuation.step_control import StepControl
from hbm.events.finer_orbits import FinerOrbits
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from small_problems import between_stops, sliding_block

COARSE, REPORTED, MANY = (
    FourierBasis(harmonics, samples)
    for harmonics, samples in ((15, 256), (15, 128), (63, 512))
)
STRIKING, BESIDE = 15.0, 15.03
"""frequencies at which the mass strikes both stops [rad/s]"""
QUIET = 100.0
"""one at which it touches neither [rad/s]"""


def orbits_of(problem: Problem) -> FinerOrbits:
    """Return those along the frequency of a problem with one coordinate."""
    path = along_frequency(problem, static_equilibrium(problem), 1.0, 2.0)
    return FinerOrbits(PathResolution(path, np.ones((1, 1))), StepControl())


def orbit(problem: Problem, frequency: float) -> Array:
    """Return the point with few harmonics to which rest leads."""
    path = along_frequency(problem, static_equilibrium(problem), 1.0, 2.0)
    rest = np.zeros(COARSE.coefficients * path.rank + 1)
    rest[-1] = frequency
    found = correct(path.balance(COARSE), rest, upright(rest), tolerance=1e-9)
    assert found.outcome is Outcome.CONVERGED
    return found.point


@pytest.mark.parametrize(("aside", "found"), [(0.01, True), (0.03, False)])
def test_a_finer_orbit_with_another_amplitude_is_another_one(
    aside: float, found: bool
) -> None:
    # 2 percent are admitted; the only orbit of a linear oscillator is so much aside
    mass, damping, stiffness, drive, frequency = 2.0, 0.5, 300.0, 1.5, 1.5
    problem = sliding_block(
        mass=mass, damping=damping, stiffness=stiffness, drive=drive, friction=0
    )
    turned = drive / (stiffness - mass * frequency**2 + 1j * frequency * damping)
    exact = np.array([turned.imag, turned.real])  # of drive · sin ωt: cosine and sine
    point = np.zeros(2 * REPORTED.harmonics + 2)
    point[1:3], point[-1] = exact / (1.0 + aside), frequency

    finer = orbits_of(problem).finer(point, REPORTED)

    assert (finer is not None) == found
    if finer is not None:
        np.testing.assert_allclose(finer[1:3], exact, rtol=1e-6)


@pytest.mark.parametrize("across", [False, True])
def test_an_orbit_begins_with_what_the_last_one_has_changed(
    across: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    problem = between_stops()
    coarse = [orbit(problem, frequency) for frequency in (STRIKING, BESIDE)]
    along = coarse[1] - coarse[0] if across else None
    iterations: list[int] = []

    def counted(*arguments: Any, **options: Any) -> Correction:
        found = correct(*arguments, **options)
        iterations.append(found.iterations)
        return found

    monkeypatch.setattr("hbm.events.finer_orbits.correct", counted)
    anew = orbits_of(problem).finer(coarse[1], MANY, along)
    orbits = orbits_of(problem)
    orbits.finer(coarse[0], MANY, along)

    found = orbits.finer(coarse[1], MANY, along)

    first, _, again = iterations
    assert found is not None
    assert anew is not None
    assert again < 0.5 * first
    np.testing.assert_allclose(found, anew, rtol=1e-4, atol=1e-7)


def test_where_that_leads_nowhere_the_orbit_itself_is_the_beginning(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = between_stops()
    begun: list[Array] = []
    orbits = orbits_of(problem)
    orbits.finer(orbit(problem, STRIKING), MANY)

    def lost_at_first(system: Any, guess: Array, *more: Any, **options: Any) -> Any:
        begun.append(guess)
        found = correct(system, guess, *more, **options)
        return replace(found, outcome=Outcome.STALLED) if len(begun) == 1 else found

    monkeypatch.setattr("hbm.events.finer_orbits.correct", lost_at_first)
    coarse = orbit(problem, BESIDE)

    assert orbits.finer(coarse, MANY) is not None

    assert not np.array_equal(begun[0], begun[1])
    np.testing.assert_array_equal(begun[1][: coarse.size - 1], coarse[:-1])


def test_a_beginning_that_leads_nowhere_is_not_tried_twice(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    problem = between_stops()
    begun: list[Array] = []
    orbits = orbits_of(problem)
    orbits.finer(orbit(problem, STRIKING), MANY)

    def lost(system: Any, guess: Array, *more: Any, **options: Any) -> Any:
        begun.append(guess)
        found = correct(system, guess, *more, **options)
        return replace(found, outcome=Outcome.STALLED)

    monkeypatch.setattr("hbm.events.finer_orbits.correct", lost)
    coarse = orbit(problem, QUIET)  # the last change would lead away from it

    assert orbits.finer(coarse, MANY) is None

    assert len(begun) == 1
    np.testing.assert_array_equal(begun[0][: coarse.size - 1], coarse[:-1])
