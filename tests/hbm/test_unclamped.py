"""Responses of structures that nothing clamps."""

import numpy as np
import pytest

from free_structures import DRIVE, MASSES, SPRINGS, chain, row
from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.shooting.comparison import compared

HERTZ = (4.0, 9.0)


def curve(problem: Problem) -> list[PeriodicResponse]:
    start, end = (2.0 * np.pi * hertz for hertz in HERTZ)
    rest = static_equilibrium(problem)
    return list(frequency_response(problem, rest, CurveOptions(start, end)))


def amplitude(problem: Problem, guess: PeriodicResponse) -> float:
    """Return the amplitude of the first mass [m] at the frequency of a guess."""
    rest = static_equilibrium(problem)
    found = periodic_response(problem, rest, guess, harmonics=31, samples=4096)
    return float(np.linalg.norm(found.seen(problem.probes.rows)[1:3, 0]))


def test_without_contacts_it_is_the_response_of_the_matrices() -> None:
    problem = chain(slider=False)
    force = np.array([DRIVE.get(f"x{place}", 0.0) for place in (1, 2, 3, 4)])

    for each in curve(problem):
        s = 1j * each.frequency
        dynamic = s**2 * np.diag(MASSES) + (1.0 + 2e-3 * s) * row(SPRINGS)
        exact = np.linalg.solve(dynamic, force)
        seen = each.seen(problem.probes.rows)
        found: Array = np.hypot(seen[1], seen[2])
        np.testing.assert_allclose(found, np.abs(exact), rtol=1e-9)


def test_soft_ropes_change_it_as_little_as_they_are_soft() -> None:
    (guess,) = (each for each in curve(chain()) if each.event == "peak")

    free, soft, stiff = (
        amplitude(chain(held=rope), guess) for rope in (0.0, 1e-2, 2e-2)
    )

    # without ropes it is what these lead to
    assert abs(soft / free - 1.0) > 1e-5
    assert 2.0 * soft - stiff == pytest.approx(free, rel=1e-7)  # measured 1.7e-8


def test_shooting_finds_the_same_orbits_and_the_stability() -> None:
    problem = chain()
    told = [each for each in curve(problem) if not each.event]

    for each in told[:: len(told) // 4]:
        found = compared(problem, each)

        assert found.as_estimated
        # shooting counts the free motion, whose multiplier is one
        assert each.unstable == 0
        assert found.found_multiplier == pytest.approx(1.0, abs=1e-6)
        assert 0.0 < found.multiplier < 1.0


def test_a_body_that_does_nothing_but_move_freely_has_the_response_of_its_mass() -> (
    None
):
    problem = system(mass=[2.0], stiffness=[0.0], drive={"x1": 1.0})

    for each in curve(problem):
        moved = np.hypot(*each.seen(problem.probes.rows)[1:3, 0])
        assert moved == pytest.approx(1.0 / (2.0 * each.frequency**2), rel=1e-9)
