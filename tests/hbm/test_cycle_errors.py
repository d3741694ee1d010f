"""What errors of energies and normal forces are made of."""

import dataclasses
import math

import numpy as np
import pytest

from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from honesty import block, jenkins
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

ROUNDING = 1e-7
"""of the largest energy, by which nobody minds that it errs"""


def curve_of(problem: Problem, options: CurveOptions) -> list[PeriodicResponse]:
    rest = static_equilibrium(problem)
    found = frequency_response(problem, rest, options)
    return [each for each in found if not each.event]


def test_friction_of_a_slider_that_only_just_slips_is_told_not_to_be_sure() -> None:
    problem = problem_of(load_scene("tip-damper"))
    turn = 2.0 * np.pi
    options = CurveOptions(
        429.925 * turn, 429.935 * turn, error=1e-2, stability=False, contact_errors=True
    )
    rest = static_equilibrium(problem)

    sticks = [
        each for each in curve_of(problem, options) if each.friction_energy < 1e-15
    ]
    slips = [
        (point, exact)
        for point in sticks
        if (
            exact := periodic_response(
                problem, rest, point, harmonics=127, samples=4096
            ).friction_energy
        )
        > 1e-10
    ]

    assert slips  # with these samples they seem to stick, with more they slip
    assert all(exact <= point.friction_error for point, exact in slips)


FIXED = {"block": (block, 6.0, 20.0), "jenkins": (jenkins, 88.0, 138.0)}


@pytest.mark.parametrize(
    ("name", "harmonics"), [("block", 1), ("block", 3), ("jenkins", 5)]
)
def test_with_fixed_harmonics_the_error_counts_what_they_leave_out(
    name: str, harmonics: int
) -> None:
    make, lowest, highest = FIXED[name]
    problem, rest = make(), static_equilibrium(make())
    options = CurveOptions(
        lowest, highest, harmonics=harmonics, stability=False, contact_errors=True
    )

    curve = curve_of(problem, options)
    most = max(point.friction_energy for point in curve)
    for point in curve[::8]:
        exact = periodic_response(problem, rest, point, harmonics=127, samples=4096)
        off = abs(point.friction_energy - exact.friction_energy)
        assert off <= point.friction_error + ROUNDING * most


def test_friction_that_is_not_resolved_counts() -> None:
    sharp = rig_problem(model="A", friction__threshold_velocity=1e-4)
    turn = 2.0 * np.pi
    options = CurveOptions(
        131.0 * turn, 133.0 * turn, error=1e-2, stability=False, contact_errors=True
    )
    rest = static_equilibrium(sharp)

    for point in curve_of(sharp, options)[::4]:
        exact = periodic_response(sharp, rest, point, harmonics=127, samples=4096)
        off = abs(point.friction_energy - exact.friction_energy)
        assert off <= point.friction_error
        # nothing else tells: friction creeps where it sticks, by the threshold
        assert off > 0.1 * exact.friction_energy


def test_nobody_pays_for_errors_of_contacts_that_are_not_asked_for() -> None:
    options = CurveOptions(6.0, 8.0, stability=False)
    asked = dataclasses.replace(options, contact_errors=True)

    points = [
        *curve_of(block(), options),  # not asked for
        *curve_of(block(), dataclasses.replace(asked, harmonics=3, errors=False)),
    ]

    assert all(math.isnan(each.friction_error) for each in points)
    assert all(math.isnan(each.damping_error) for each in points)
    assert all(np.isnan(each.normal_error).all() for each in points)
