"""The catalogue: every law has examples; its tangents are those of differences."""

import dataclasses
import inspect

import numpy as np
import pytest

from law_examples import CASES, NAMES, element
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.memory import Press, beyond_motion, remembers, traction
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.element import interface_of
from microslip_mechanics.laws.catalogue import LAWS, law_name
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.laws.jenkins import Jenkins

STEP = 1e-6


def points_of(case: str) -> ContactPoints:
    return interface_of([element(case)], NAMES).points


def force(points: ContactPoints, point: int, motion: Array) -> tuple[Array, Array]:
    """Return the force of (displacement, velocity) and its derivatives, (3, 6)."""
    made, by_displacement, by_velocity = np.empty(3), np.empty((3, 3)), np.empty((3, 3))
    contact_force(
        points, point, motion[:3], motion[3:], made, by_displacement, by_velocity
    )
    return made, np.hstack([by_displacement, by_velocity])


def pulled(points: ContactPoints, point: int, state: Array) -> tuple[Array, Array]:
    """Return the traction and its derivatives.

    By slide, velocity, loads after and before, old traction, depths after and before.
    """
    new, by = np.empty(2), np.empty((2, 10))
    slide, velocity, (load, past), old, (depth, above) = np.split(state, 5)
    after, before = Press(load, depth), Press(past, above)
    traction(points, point, slide, velocity, after, before, old, new, by)
    return new, by


def test_every_law_of_the_catalogue_has_an_example() -> None:
    assert {name for name, *_ in CASES.values()} == set(LAWS)
    for name, law in LAWS.items():
        assert law_name(law) == name


def test_laws_say_what_they_are_in_one_line_with_an_equation() -> None:
    for law in LAWS.values():
        assert dataclasses.is_dataclass(law)
        line = str(law.__doc__).splitlines()[0]
        assert "=" in line, law


def test_help_of_a_law_tells_unit_range_and_what_stands_for_each_number() -> None:
    assert inspect.getdoc(Jenkins) == (
        "dF = k_t dw while |F| < R, else F = ±R (elastic Coulomb; Jenkins, 1962).\n\n"
        "Parameters\n----------\n"
        "stiffness\n    [N/m], above 0\n"
        "limit\n    [N], at least 0"
    )
    contact = str(inspect.getdoc(HuntCrossleyContact))
    assert "\nexponent\n    at least 1, at most 10, 1.5 if left out\n" in contact
    for law in LAWS.values():
        told = str(inspect.getdoc(law)).split("\nParameters\n----------\n")[1]
        names = [line for line in told.splitlines() if not line.startswith(" ")]
        assert names == [field.name for field in dataclasses.fields(law)]


@pytest.mark.parametrize("case", CASES)
def test_tangents_are_central_differences_of_the_force(case: str) -> None:
    points, random = points_of(case), np.random.default_rng(3)
    acted = False
    for point in range(points.load.size):
        for motion in random.uniform(-0.5, 0.5, (40, 6)):
            _, exact = force(points, point, motion)
            for column, push in enumerate(STEP * np.eye(6)):
                high, _ = force(points, point, motion + push)
                low, _ = force(points, point, motion - push)
                slope = (high - low) / (2.0 * STEP)
                scale = max(1.0, float(np.abs(exact).max()))
                np.testing.assert_allclose(exact[:, column], slope, atol=1e-6 * scale)
            acted |= bool(exact.any())
    assert acted or beyond_motion(points)


@pytest.mark.parametrize(
    "case", [each for each in CASES if remembers(points_of(each)).any()]
)
def test_tangents_of_what_remembers_are_central_differences(case: str) -> None:
    points, random = points_of(case), np.random.default_rng(4)
    for point in range(points.load.size):
        constant = bool(points.constant_load[point])
        load, change = (points.load[point], 0.0) if constant else (1.0, 0.2)
        limit = points.dynamic[point] * load
        reach = limit / points.tangential[point]
        # what was before stays within its limit
        scale = np.array([reach, 1.0, change, 0.8 * limit, 0.0 if constant else 1.0])
        scale = np.repeat(scale, 2)
        touches = 0
        for draw in random.uniform(-0.7, 0.7, (40, 10)):
            state = scale * draw
            state[4:6] += load
            _, exact = pulled(points, point, state)
            touches += state[9] < 0.0 < state[8]
            for column in range(10):
                push = np.zeros(10)
                push[column] = 1e-6 * (scale[column] or load)
                high, _ = pulled(points, point, state + push)
                low, _ = pulled(points, point, state - push)
                slope = (high - low) / (2.0 * push[column])
                size = max(float(np.abs(exact[:, column]).max()), 1e-3)
                np.testing.assert_allclose(
                    exact[:, column], slope, atol=1e-6 * size, rtol=1e-6
                )
        assert constant or touches > 5


def test_true_is_no_number() -> None:
    with pytest.raises(ValueError, match="stiffness = True: give a number"):
        Jenkins(stiffness=True, limit=1.0)


@pytest.mark.parametrize("kind", [np.int64, np.float32, np.float64])
def test_numbers_of_numpy_are_numbers(kind: type) -> None:
    assert Jenkins(stiffness=kind(5), limit=1.0).stiffness == 5.0
