"""Continuation: folds, ends, steps and the text of its errors."""

import dataclasses
import itertools
import math

import numpy as np
import pytest

from hbm.continuation.arc import tangent
from hbm.continuation.continuation import trace
from hbm.continuation.corrected import correct_at
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import System
from hbm.continuation.newton import Small
from hbm.continuation.settler import Unsettled
from hbm.continuation.step_control import StepControl
from hbm.errors import ContinuationError
from microslip_mechanics.arrays import Array
from systems import Dense

CONTROL = StepControl(initial=0.05, smallest=1e-5, largest=0.2, tolerance=1e-10)

FOLD = 2.0 / (3.0 * math.sqrt(3.0))
"""parameter of the folds of :func:`cubic`, with either sign"""


def even(point: Array) -> Array:
    """Measure arc length with all components alike."""
    return np.ones_like(point)


def cubic(point: Array) -> tuple[Array, Dense]:
    """Return x³ − x − p: folds at x = ±1/√3."""
    x, parameter = point
    return np.array([x**3 - x - parameter]), Dense([[3.0 * x**2 - 1.0, -1.0]])


def circle(point: Array) -> tuple[Array, Dense]:
    return np.array([point @ point - 1.0]), Dense(2.0 * point[None])


def line(point: Array) -> tuple[Array, Dense]:
    x, parameter = point
    return np.array([x - 2.0 * parameter]), Dense([[1.0, -2.0]])


def bend(point: Array) -> tuple[Array, Dense]:
    """Return x − 10 |p|, its corner rounded over a thousandth."""
    x, parameter = point
    root = math.hypot(parameter, 1e-3)
    return np.array([x - 10.0 * root]), Dense([[1.0, -10.0 * parameter / root]])


def traced(
    system: System, start: Array, end: float, control: StepControl = CONTROL
) -> Array:
    """Return all points of a curve, shape (points, 2)."""
    curve = trace(system, start, end, metric=even, control=control)
    return np.array([each.point for each in itertools.islice(curve, 2000)])


def test_continuation_passes_both_folds_of_a_cubic() -> None:
    curve = traced(cubic, np.array([-1.3, -1.0]), 1.0)

    x, parameter = curve.T
    assert np.all(np.diff(x) > 0.0)  # never turns back
    turns = x[:-1][np.diff(np.sign(np.diff(parameter)), prepend=1.0) != 0.0]
    assert len(turns) == 2
    np.testing.assert_allclose(turns, [-1.0, 1.0] / np.sqrt(3.0), atol=CONTROL.largest)
    extremes = [parameter[x < 0.0].max(), parameter[x > 0.0].min()]
    # Half a step beside a fold, √3 (0.2 / 2)² and what a bent step is longer.
    np.testing.assert_allclose(extremes, [FOLD, -FOLD], atol=0.025)


def test_every_point_of_a_curve_solves_the_system() -> None:
    curve = traced(cubic, np.array([-1.3, -1.0]), 1.0)

    assert curve[-1, 1] == 1.0
    for point in curve:
        assert abs(cubic(point)[0][0]) <= CONTROL.tolerance


def test_points_let_go_of_their_factors(monkeypatch: pytest.MonkeyPatch) -> None:
    forgotten: list[Dense] = []
    monkeypatch.setattr(Dense, "forget", lambda each: forgotten.append(each))

    *points, _ = trace(cubic, np.array([-1.3, -1.0]), 1.0, metric=even, control=CONTROL)

    assert len(points) > 10
    assert all(each.linearised in forgotten for each in points)


@pytest.mark.parametrize(("begin", "end"), [(-1.0, 1.0), (1.0, -1.0), (-0.5, 0.7)])
def test_both_ends_of_a_curve_lie_exactly_on_their_parameters(
    begin: float, end: float
) -> None:
    # On the outer branches: those that the curve has at the ends of its range.
    start = np.array([math.copysign(1.3, begin), begin])

    curve = traced(cubic, start, end)

    assert curve[0, -1] == begin
    assert curve[-1, -1] == end
    low, high = sorted((begin, end))
    assert np.all((curve[1:-1, -1] > low) & (curve[1:-1, -1] < high))


def test_a_curve_that_folds_back_ends_exactly_where_it_began() -> None:
    curve = traced(circle, np.array([0.8, 0.1]), 5.0)

    assert curve[-1, -1] == curve[0, -1] == 0.1
    assert curve[-1, 0] == pytest.approx(-math.sqrt(0.99), abs=1e-9)
    assert curve[:, -1].max() == pytest.approx(1.0, abs=CONTROL.largest**2)


def test_a_closed_curve_ends_where_it_began() -> None:
    start = np.array([0.8, -0.6])
    points = [
        each.point
        for each in trace(circle, start, 2.0, metric=even, control=CONTROL, begin=-2.0)
    ]

    np.testing.assert_allclose(points[-1], points[0], rtol=0.0, atol=1e-9)
    angles = np.unwrap(np.arctan2(*np.array(points).T))
    assert abs(angles[-1] - angles[0]) == pytest.approx(2.0 * math.pi, abs=1e-8)


def test_a_curve_that_cannot_begin_on_a_fold_says_so() -> None:
    with pytest.raises(ContinuationError, match=r"begin a little beside it$"):
        next(trace(circle, np.array([0.0, 1.0]), 2.0, metric=even, control=CONTROL))


def test_a_curve_goes_on_from_the_middle_of_its_range() -> None:
    begun = trace(
        cubic,
        np.array([0.0, 0.0]),
        1.0,
        metric=even,
        control=CONTROL,
        begin=-1.0,
        direction=np.array([1.0, 0.0]),
    )

    x, parameter = np.array([each.point for each in begun]).T

    # On the middle branch x grows where p falls, down to the fold and up to the end;
    # half a step beside the fold p is √3 (0.2 / 2)² above it.
    assert np.all(np.diff(x) > 0.0)
    assert parameter.min() == pytest.approx(-FOLD, abs=0.02)
    assert parameter[-1] == 1.0


def test_steps_grow_where_the_curve_is_straight_up_to_the_largest() -> None:
    control = StepControl(initial=0.01, largest=0.3)

    curve = traced(line, np.array([-10.0, -5.0]), 5.0, control)

    # No iteration is needed on a line: each step is twice the one before.
    steps = np.linalg.norm(np.diff(curve, axis=0), axis=1)
    expected = np.minimum(0.01 * 2.0 ** np.arange(len(steps) - 1), 0.3)
    np.testing.assert_allclose(steps[:-1], expected, rtol=1e-9)


def test_steps_are_measured_in_the_metric() -> None:
    control, scale = StepControl(initial=0.1, largest=0.1), np.array([4.0, 0.5])

    curve = trace(
        line, np.array([0.0, 0.0]), 1.0, metric=lambda _: scale, control=control
    )

    points = np.array([each.point for each in curve])
    steps = np.linalg.norm(np.diff(points, axis=0) / scale, axis=1)
    np.testing.assert_allclose(steps[:-1], 0.1, rtol=1e-9)


def test_no_step_turns_by_more_than_the_sharpest_turn() -> None:
    control = StepControl(initial=0.1, largest=2.0, sharpest_turn=0.8)

    curve = traced(bend, np.array([30.0, -3.0]), 3.0, control)

    slopes = 10.0 * curve[:, 1] / np.hypot(curve[:, 1], 1e-3)
    directions = np.column_stack([slopes, np.ones(len(curve))])
    directions /= np.linalg.norm(directions, axis=1)[:, None]
    cosines = np.sum(directions[1:] * directions[:-1], axis=1)
    assert cosines[:-1].min() > 0.8  # the last step is cut at the end


def test_the_tangent_lies_on_the_curve_and_has_length_one_in_the_metric() -> None:
    point, scale = np.array([1.2, 1.2**3 - 1.2]), np.array([2.0, 0.3])
    _, linearised = cubic(point)

    along = tangent(linearised, np.array([0.0, 1.0]), scale)

    assert linearised.rows @ along == pytest.approx(0.0, abs=1e-14)
    assert np.linalg.norm(along / scale) == pytest.approx(1.0)
    assert along[-1] > 0.0


def test_a_curve_without_a_first_point_says_why() -> None:
    def nowhere(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        return np.array([x**2 + 1.0]), Dense([[2.0 * x, 0.0 * parameter]])

    text = (
        r"^no response is found at parameter 3: "
        r"no step along Newton's direction lowers the residual "
        r"\(residual 1\.0e\+00 after 0 iterations, tolerance 1\.0e-10\); "
        r"another tolerance, more harmonics, more samples or, where friction has one, "
        r"a larger threshold velocity may help$"
    )
    with pytest.raises(ContinuationError, match=text):
        next(trace(nowhere, np.array([1e-3, 3.0]), 4.0, metric=even, control=CONTROL))


def broken(point: Array) -> tuple[Array, Dense]:
    """Return the line, as far as p = 0.5."""
    residual, linearised = line(point)
    return (residual if point[-1] < 0.5 else np.array([np.inf])), linearised


def test_a_curve_that_breaks_off_says_where_and_keeps_what_it_has() -> None:
    curve = trace(broken, np.array([0.0, 0.0]), 1.0, metric=even, control=CONTROL)
    points: list[Array] = []

    text = (
        r"^the curve does not go on at parameter 0\.4999\d*: the residual is not fini"
    )
    with pytest.raises(ContinuationError, match=text):
        points.extend(correction.point for correction in curve)

    # The last step was the shortest one.
    assert 0.5 - CONTROL.smallest < points[-1][-1] < 0.5


def test_a_point_is_corrected_at_its_own_parameter() -> None:
    correction = correct_at(cubic, np.array([2.0, 0.7]), CONTROL)

    assert correction.point[-1] == 0.7
    assert abs(cubic(correction.point)[0][0]) <= CONTROL.tolerance


class Picky(Unsettled):
    """Returns points rounded in x, refuses some, and notes what it is told."""

    def __init__(self, refused: int = 0) -> None:
        self.refused, self.told = refused, list[str]()
        self.changed = False

    def settle(
        self,
        correction: Correction,
        normal: Array,
        tolerance: float,
        small: Small | None = None,
    ) -> Correction:
        assert small is None
        assert normal.shape == correction.point.shape
        assert tolerance == CONTROL.tolerance
        self.told.append("settle")
        if len(self.told) > 1 and self.refused > 0:
            self.refused -= 1
            return dataclasses.replace(correction, outcome=Outcome.STALLED)
        return correction

    def keep(self, _: float = 0.0) -> None:
        self.told.append("keep")

    def retreat(self, times: int) -> None:
        self.told.append(f"retreat {times}")


def settled(settler: Picky, points: int) -> Array:
    curve = trace(
        line,
        np.array([0.0, 0.0]),
        1.0,
        metric=even,
        control=CONTROL,
        settler=settler,
    )
    return np.array([each.point for each in itertools.islice(curve, points)])


def test_a_settler_sees_each_point_before_it_is_kept() -> None:
    settler = Picky()

    settled(settler, 4)

    assert settler.told == ["settle", "keep"] * 4


def test_a_point_that_a_settler_refuses_is_sought_again_with_half_the_step() -> None:
    settler = Picky(refused=2)

    points = settled(settler, 2)

    assert settler.told == [
        *("settle", "keep"),
        *("settle", "retreat 1", "settle", "retreat 2", "settle", "keep"),
    ]
    steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert steps[0] == pytest.approx(CONTROL.initial / 4.0)


def test_a_system_that_changes_may_move_a_point_by_more_than_the_step() -> None:
    settler = Picky(refused=3)

    def shifted(point: Array) -> tuple[Array, Dense]:
        settler.changed = "retreat 3" in settler.told
        residual, linearised = line(point)
        return residual + 0.05 * settler.changed, linearised

    curve = trace(
        shifted, np.zeros(2), 1.0, metric=even, control=CONTROL, settler=settler
    )
    points = [each.point for each in itertools.islice(curve, 2)]

    # The line is 0.05 / √5 away, along which the step is an eighth of the first.
    assert settler.told[-2:] == ["settle", "keep"]
    assert "retreat 4" not in settler.told
    along = np.array([2.0, 1.0]) / np.sqrt(5.0)
    assert along @ (points[1] - points[0]) == pytest.approx(CONTROL.initial / 8.0)


class Leaping(Picky):
    """Moves points to the neighbouring line the first time it makes them finer."""

    def settle(
        self,
        correction: Correction,
        normal: Array,
        tolerance: float,
        small: Small | None = None,
    ) -> Correction:
        found = super().settle(correction, normal, tolerance, small)
        if self.told.count("settle") != 2:
            return found
        return dataclasses.replace(found, point=found.point + 0.4 * normal)


def test_a_point_that_settling_moves_far_away_is_sought_from_the_prediction() -> None:
    settler = Leaping()

    points = settled(settler, 3)

    assert settler.told == [*("settle", "keep"), "settle", *("settle", "keep") * 2]
    for point in points:
        assert np.abs(line(point)[0]).max() < 1e-9
