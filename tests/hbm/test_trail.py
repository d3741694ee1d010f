"""Curves that come back to where they have been."""

import itertools

import numpy as np
import pytest

from hbm.balance.linearisation import Linearisation
from hbm.continuation.continuation import trace
from hbm.continuation.step_control import StepControl
from hbm.errors import ReturnedError
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
