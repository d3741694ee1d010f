"""Curves that come back to where they have been."""

import itertools
from collections.abc import Iterator

import numpy as np
import pytest

from hbm.balance.linearisation import Linearisation
from hbm.continuation.continuation import trace
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.step_control import StepControl
from hbm.continuation.trail import Trail
from hbm.errors import RetracedError, ReturnedError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from random_systems import random_system
from systems import Dense

CONTROL = StepControl(initial=0.05, smallest=1e-5, largest=0.2, tolerance=1e-10)


class Unoriented(Dense):
    """A Jacobian whose determinant is not known, as where it is solved iteratively."""

    def orientation(self, tangent: Array) -> float:  # noqa: ARG002
        return 0.0


def six(point: Array) -> tuple[Array, Dense]:
    """Return what is zero on a circle, and on a line that touches it at (1, 0)."""
    x, parameter = point
    circle, rows = point @ point - 1.0, 2.0 * point[None]
    if x < 0.0 or parameter > 0.0:
        return np.array([circle]), Unoriented(rows)
    rows = rows * (x - 1.0) + circle * np.array([[1.0, 0.0]])
    return np.array([(x - 1.0) * circle]), Unoriented(rows)


def circle(point: Array) -> tuple[Array, Dense]:
    """Return what is zero on a circle."""
    return np.array([point @ point - 1.0]), Dense(2.0 * point[None])


def thin(point: Array) -> tuple[Array, Dense]:
    """Return what is zero on an ellipse, two hundred times as long as it is wide."""
    scaled = point / np.array([5e-3, 1.0])
    rows = 2.0 * scaled / np.array([5e-3, 1.0])
    return np.array([scaled @ scaled - 1.0]), Dense(rows[None])


def on_circle(turn: float, way: float) -> Correction:
    """Return the point of the circle at an angle, followed in one direction."""
    point = np.array([np.cos(turn), np.sin(turn)])
    residual, linearised = circle(point)
    tangent = way * np.array([-np.sin(turn), np.cos(turn)])
    return Correction(point, residual, linearised, Outcome.CONVERGED, (0.0,), tangent)


def go_back(trail: Trail, turns: Iterator[float]) -> None:
    """Take steps along the circle, against its direction before."""
    for turn in turns:
        each = on_circle(turn, -1.0)
        assert not trail.comes_back(each.point, np.ones(2))
        trail.append(each)


def helix(point: Array) -> tuple[Array, Dense]:
    """Return what is zero on a helix round an axis, a hundredth from turn to turn."""
    x, height, parameter = point
    turn = 200.0 * np.pi
    sine, cosine = np.sin(turn * height), np.cos(turn * height)
    rows = [[1.0, turn * sine, 0.0], [0.0, -turn * cosine, 1.0]]
    return np.array([x - cosine, parameter - sine]), Dense(rows)


def test_a_curve_that_runs_into_itself_ends_there_and_says_so() -> None:
    points: list[Array] = []
    curve = trace(six, np.array([1.0, -1.5]), 2.0, metric=np.ones_like, control=CONTROL)

    with pytest.raises(ReturnedError, match=r"comes back at parameter 0\.[01]\d* to"):
        points.extend(each.point for each in itertools.islice(curve, 200))

    x, parameter = np.array(points).T
    round_it = np.unwrap(np.arctan2(parameter, x)[parameter.argmax() :])
    assert 1.5 * np.pi - 0.3 < np.ptp(round_it) < 1.5 * np.pi + 0.3


def test_a_curve_may_wind_close_by_where_it_has_been() -> None:
    start = np.array([1.0, 0.0, 0.0])
    curve = trace(helix, start, 2.0, metric=np.ones_like, control=CONTROL, begin=-2.0)

    heights = np.array([each.point[1] for each in itertools.islice(curve, 150)])

    assert heights.size == 150
    assert (np.diff(heights) > 0.0).all()
    assert heights[-1] > 0.02


def test_a_curve_that_goes_back_the_way_it_came_ends_and_says_where_it_turned() -> None:
    """What has turned on its own branch would retrace all of it."""
    trail = Trail(circle, CONTROL)
    for turn in np.linspace(-0.5, 1.0, 31):
        trail.append(on_circle(turn, 1.0))
    back = iter(np.linspace(0.97, -0.23, 25))

    with pytest.raises(RetracedError, match=r"comes back at parameter 0\.841"):
        go_back(trail, back)

    assert len(list(back)) == 13  # two pass what it has just left, ten are enough


def test_a_curve_may_go_back_close_by_where_it_came() -> None:
    """A hundredth of a step away, as on a branch that a fold parts from another."""
    start = np.array([-5e-3, 0.0])
    curve = trace(thin, start, 2.0, metric=np.ones_like, control=CONTROL, begin=-2.0)

    points = [each.point for each in curve]

    np.testing.assert_allclose(points[-1], points[0], atol=1e-12)
    assert max(point[0] for point in points) == pytest.approx(5e-3, rel=0.1)


@pytest.mark.long
def test_a_curve_begins_anew_beyond_a_closed_one_that_it_was_led_to(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # what is not known of large systems shows a step that another curve is not its own
    monkeypatch.setattr(Linearisation, "orientation", lambda *_: 0.0)
    problem = random_system(0)
    options = CurveOptions(5.0, 60.0, harmonics=7, errors=False, stability=False)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    events = [each.event for each in curve]
    beyond = curve[events.index("restart") :]
    folds = [each.parameter for each in beyond if each.event == "fold"]
    # of steps a fifth and a tenth as long
    assert folds == pytest.approx([38.68833, 38.67319], abs=1e-4)
    assert curve[-1].parameter == 60.0
    assert events.count("restart") == 1
    assert len(curve) < 200  # 5138 where it went round until points ran out


def test_a_trail_knows_where_its_curve_has_been_between_its_points() -> None:
    trail = Trail(six, CONTROL)
    for turn in np.linspace(-1.5, 1.0, 26):
        trail.append(on_circle(float(turn), 1.0))

    def been(point: Array) -> bool:
        return trail.has_been_at(point, np.ones(2))

    assert been(on_circle(-0.33, 1.0).point)
    assert been(on_circle(0.4, -1.0).point)
    assert not been(on_circle(1.3, 1.0).point)  # farther than it has come
    assert not been(on_circle(0.98, 1.0).point)  # where it is now
    assert not been(np.array([1.0, -0.05]))  # on the line beside the circle


def test_a_trail_that_tells_a_point_twice_knows_what_is_beside_it() -> None:
    trail = Trail(six, CONTROL)
    for turn in (-1.5, -1.4, -1.4, -1.3, *np.linspace(-1.2, 0.0, 8)):
        trail.append(on_circle(float(turn), 1.0))

    with np.errstate(invalid="raise", divide="raise"):
        assert trail.has_been_at(on_circle(-1.45, 1.0).point, np.ones(2))


def test_a_trail_without_points_has_been_nowhere() -> None:
    assert not Trail(six, CONTROL).has_been_at(np.array([1.0, 0.0]), np.ones(2))
