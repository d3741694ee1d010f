"""Friction as a projection: the same law, and a choice that does not need V_lim."""

import numpy as np
import pytest

from contact_tables import FRICTION_LAWS, contact_points
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.points import ContactPoints
from timedomain.contact.point_law import linearise

pytestmark = pytest.mark.kernels

SPEEDS = {"at rest": 0.0, "sticking": 0.03, "at the threshold": 0.0999, "sliding": 0.7}
WEIGHTS = (0.01, 3.0, 1e4)


def law(points: ContactPoints, gap: Array, slip: Array) -> tuple[Array, Array, Array]:
    """Return force and tangents of the contact law."""
    force, by_gap, by_slip = np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    contact_force(points, 0, gap, slip, force, by_gap, by_slip)
    return force, by_gap[:, 0], by_slip


def lines(
    points: ContactPoints, gap: Array, slip: Array, force: Array, weight: float
) -> tuple[Array, Array, Array]:
    """Return the linearised force and its slopes, from a force on."""
    line, by_gap, by_slip = np.zeros((1, 3)), np.zeros((1, 3)), np.zeros((1, 3, 3))
    linearise(
        points,
        0,
        weight,
        False,
        np.zeros(0),
        gap[None],
        slip[None],
        force[None],
        line,
        by_gap,
        by_slip,
    )
    return line[0], by_gap[0], by_slip[0]


@pytest.mark.parametrize("friction", FRICTION_LAWS)
@pytest.mark.parametrize("speed", SPEEDS.values(), ids=SPEEDS)
@pytest.mark.parametrize("constant", [False, True])
@pytest.mark.parametrize("weight", WEIGHTS)
def test_at_its_solution_it_is_the_law_with_the_same_tangents(
    friction: str, speed: float, constant: bool, weight: float
) -> None:
    points = contact_points(friction=FRICTION_LAWS[friction], constant_load=constant)
    gap, slip = np.array([0.4, 0.0, 0.0]), np.array([0.2, 0.6 * speed, 0.8 * speed])
    expected = law(points, gap, slip)

    found = lines(points, gap, slip, expected[0], weight)

    for each, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, other, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("speed", [0.03, 0.7])
def test_a_constant_load_of_zero_leaves_the_viscous_drag(speed: float) -> None:
    points = contact_points(friction=FRICTION_LAWS["gkf"], constant_load=True, load=0.0)
    gap, slip = np.array([-0.4, 0.0, 0.0]), np.array([0.2, 0.6 * speed, 0.8 * speed])
    expected = law(points, gap, slip)

    found = lines(points, gap, slip, expected[0], 3.0)

    assert expected[0][1] > 0.0
    for each, other in zip(found, expected, strict=True):
        np.testing.assert_allclose(each, other, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("friction", ["coulomb", "gkf"])
@pytest.mark.parametrize("speed", [0.03, 0.7])
def test_what_is_no_solution_stays_none(friction: str, speed: float) -> None:
    points = contact_points(friction=FRICTION_LAWS[friction])
    gap, slip = np.array([0.4, 0.0, 0.0]), np.array([0.2, 0.6 * speed, 0.8 * speed])
    force, _, _ = law(points, gap, slip)
    other = force + np.array([0.0, -0.3, 0.1])

    line, _, _ = lines(points, gap, slip, other, 3.0)

    assert np.abs(line - other).max() > 1e-3


@pytest.mark.parametrize("gap", [-0.1, 0.0])
def test_a_point_that_is_apart_carries_nothing(gap: float) -> None:
    points = contact_points()
    far, fast = np.array([gap, 0.0, 0.0]), np.array([0.3, 0.5, 0.1])

    for each in lines(points, far, fast, np.array([1.0, 0.2, 0.1]), 3.0):
        np.testing.assert_array_equal(each, 0.0)


def test_a_force_below_the_limit_holds_a_point_that_slides_in_the_guess() -> None:
    # An effective mass per step of 1 needs 0.1 to stop 0.1 m/s: below µN = 0.51.
    points = contact_points(constant_load=True, threshold=1e-12)
    slip = np.array([0.0, 0.1, 0.0])

    _, _, held = lines(points, np.zeros(3), slip, np.zeros(3), 1.0)
    _, _, by_velocity = lines(points, np.zeros(3), slip, np.zeros(3), 1e30)

    assert held[1, 1] == pytest.approx(0.51e12)
    assert by_velocity[1, 1] < 1e-6
