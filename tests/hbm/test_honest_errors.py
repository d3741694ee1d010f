"""Whether told errors cover the true ones: of amplitudes, energies, normal forces."""

from collections.abc import Iterable

import numpy as np
import pytest

from honesty import VARIANTS, errors, pairs
from microslip_mechanics.arrays import Array

ROUNDING = 1e-7
"""of the largest energy, by which nobody minds that it errs"""
RUBBING = sorted(set(VARIANTS) - {"bouncing"})


def pessimism(names: Iterable[str]) -> float:
    """Return the median of estimated over true errors; rounding does not count."""
    estimated, true = map(np.concatenate, zip(*map(errors, names), strict=True))
    moves = true > 1e-10
    return float(np.median(estimated[moves] / true[moves]))


@pytest.mark.parametrize("name", VARIANTS)
def test_the_error_bounds_the_true_one_at_nearly_all_points(name: str) -> None:
    estimated, true = errors(name)

    # What the linear rigs err by rounding is not estimated.
    assert np.mean(true <= estimated + 1e-12) >= 0.95


def test_the_error_bounds_the_true_one_where_contacts_are_marched() -> None:
    estimated, true = errors("jenkins", error=1e-2, count=60)

    # How far transitions are from samples is an accident at each point: doubled
    # samples by themselves bound 91 % of these.
    assert np.mean(true <= estimated + 1e-12) >= 0.95


def test_the_error_is_not_far_above_the_true_one() -> None:
    assert pessimism(VARIANTS) <= 10.0  # measured 6


@pytest.mark.parametrize("name", VARIANTS)
def test_in_no_problem_the_error_is_very_far_above_the_true_one(name: str) -> None:
    # Measured 5 to 19, most for the bouncing mass, which hardly ever parts.
    assert pessimism([name]) <= 20.0


def test_over_all_problems_the_error_bounds_49_of_50_points() -> None:
    found = [errors(name) for name in VARIANTS]

    estimated, true = (np.concatenate(part) for part in zip(*found, strict=True))
    # Measured 98.9 %; the two others (A and B, GKF) err 1.9 times as much as they say.
    assert np.mean(true <= estimated + 1e-12) >= 0.98
    assert np.all(true <= 2.0 * estimated + 1e-12)


@pytest.mark.parametrize("name", VARIANTS)
def test_no_point_errs_by_more_than_the_tolerance(name: str) -> None:
    _, true = errors(name)

    assert np.all(true <= 1e-3)  # measured 5.7e-4


def of_friction(name: str) -> tuple[Array, Array]:
    """Return told and true errors of friction's energy, over the largest."""
    found = pairs(name)
    most = max(point.friction_energy for point, _ in found)
    told = [point.friction_error for point, _ in found]
    true = [abs(each.friction_energy - exact.friction_energy) for each, exact in found]
    return np.array(told) / most, np.array(true) / most


@pytest.mark.parametrize("name", RUBBING)
def test_the_error_of_friction_bounds_the_true_one_at_nearly_all_points(
    name: str,
) -> None:
    told, true = of_friction(name)

    assert np.mean(true <= told + ROUNDING) >= 0.95


def test_the_error_of_damping_bounds_the_true_one_where_faces_part() -> None:
    found = pairs("bouncing")

    told = np.array([point.damping_error for point, _ in found])
    taken = np.array([[each.damping_energy for each in pair] for pair in found])
    true, most = np.abs(np.diff(taken, axis=1))[:, 0], taken.max()
    assert np.mean(true <= told + ROUNDING * most) >= 0.95
    assert true.max() > 1e-5 * most


def of_forces(name: str) -> tuple[Array, Array]:
    """Return told and true errors of the extremes of normal forces, over the largest.

    Of the contact at each point that errs most beyond what is told.
    """
    told, true = [], []
    for point, exact in pairs(name):
        smallest = abs(point.normal_smallest - exact.normal_smallest)
        largest = abs(point.normal_largest - exact.normal_largest)
        off = np.maximum(smallest, largest)
        worst = (off - point.normal_error).argmax()
        told.append(point.normal_error[worst])
        true.append(off[worst])
    most = max(abs(point.normal_largest).max() for point, _ in pairs(name))
    return np.array(told) / most, np.array(true) / most


@pytest.mark.parametrize("name", ["bouncing", "full"])
def test_the_error_of_normal_forces_bounds_the_true_one_at_nearly_all_points(
    name: str,
) -> None:
    told, true = of_forces(name)

    assert np.mean(true <= told + ROUNDING) >= 0.95
    assert true.max() > 1e-5


def test_errors_of_friction_are_not_far_above_the_true_ones() -> None:
    found = [of_friction(name) for name in RUBBING]

    told, true = (np.concatenate(part) for part in zip(*found, strict=True))
    moves = np.maximum(told, true) > ROUNDING
    assert np.median(told[moves] / true[moves]) <= 15.0  # measured 11
