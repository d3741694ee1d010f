"""Errors of energies: whether they cover the true ones, and what they are made of."""

import dataclasses
import math

import numpy as np
import pytest

from hbm.curves.periodic_response import periodic_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from honesty import VARIANTS, block, jenkins, solved_again
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

ROUNDING = 1e-7
"""of the largest energy, by which nobody minds that it errs"""
RUBBING = sorted(set(VARIANTS) - {"bouncing"})


def of_friction(name: str) -> tuple[Array, Array]:
    """Return told and true errors of friction's energy, over the largest."""
    pairs = solved_again(name)
    most = max(point.friction_energy for point, _ in pairs)
    told = [point.friction_error for point, _ in pairs]
    true = [abs(each.friction_energy - exact.friction_energy) for each, exact in pairs]
    return np.array(told) / most, np.array(true) / most


@pytest.mark.parametrize("name", RUBBING)
def test_the_error_of_friction_bounds_the_true_one_at_nearly_all_points(
    name: str,
) -> None:
    told, true = of_friction(name)

    assert np.mean(true <= told + ROUNDING) >= 0.95


def test_the_error_of_damping_bounds_the_true_one_where_faces_part() -> None:
    pairs = solved_again("bouncing")

    told = np.array([point.damping_error for point, _ in pairs])
    taken = np.array([[each.damping_energy for each in pair] for pair in pairs])
    true, most = np.abs(np.diff(taken, axis=1))[:, 0], taken.max()
    assert np.mean(true <= told + ROUNDING * most) >= 0.95
    assert true.max() > 1e-5 * most


def test_errors_of_friction_are_not_far_above_the_true_ones() -> None:
    found = [of_friction(name) for name in RUBBING]

    told, true = (np.concatenate(part) for part in zip(*found, strict=True))
    moves = np.maximum(told, true) > ROUNDING
    assert np.median(told[moves] / true[moves]) <= 15.0  # measured 11


def curve_of(problem: Problem, options: CurveOptions) -> list[PeriodicResponse]:
    rest = static_equilibrium(problem)
    found = frequency_response(problem, rest, options)
    return [each for each in found if not each.event]


def test_friction_of_a_slider_that_only_just_slips_is_told_not_to_be_sure() -> None:
    problem = problem_of(load_scene("tip-damper"))
    turn = 2.0 * np.pi
    options = CurveOptions(
        429.925 * turn, 429.935 * turn, error=1e-2, stability=False, energies=True
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
    make, *ends = FIXED[name]
    problem, rest = make(), static_equilibrium(make())
    options = CurveOptions(*ends, harmonics=harmonics, stability=False, energies=True)

    curve = curve_of(problem, options)
    most = max(point.friction_energy for point in curve)
    for point in curve[::8]:
        exact = periodic_response(problem, rest, point, harmonics=127, samples=4096)
        off = abs(point.friction_energy - exact.friction_energy)
        assert off <= point.friction_error + ROUNDING * most


def test_friction_that_is_not_resolved_counts() -> None:
    sharp = rig_problem(model="A", friction__threshold_velocity=1e-4)
    ends = 2.0 * np.pi * np.array([131.0, 133.0])
    options = CurveOptions(*ends, error=1e-2, stability=False, energies=True)
    rest = static_equilibrium(sharp)

    for point in curve_of(sharp, options)[::4]:
        exact = periodic_response(sharp, rest, point, harmonics=127, samples=4096)
        off = abs(point.friction_energy - exact.friction_energy)
        assert off <= point.friction_error
        # nothing else tells: friction creeps where it sticks, by the threshold
        assert off > 0.1 * exact.friction_energy


def test_nobody_pays_for_errors_of_energies_that_are_not_asked_for() -> None:
    options = CurveOptions(6.0, 8.0, stability=False)
    asked = dataclasses.replace(options, energies=True)
    springs = problem_of(load_scene("duffing"))

    points = [
        *curve_of(block(), options),  # not asked for
        *curve_of(springs, asked),  # of what takes out nothing
        *curve_of(block(), dataclasses.replace(asked, harmonics=3, errors=False)),
    ]

    assert all(math.isnan(each.friction_error) for each in points)
    assert all(math.isnan(each.damping_error) for each in points)
