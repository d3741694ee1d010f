"""Continuation: folds, ends, steps and the text of its errors."""

import itertools
import math

import numpy as np
import pytest

from hbm.continuation import (
    ContinuationError,
    StepControl,
    correct_at,
    tangent,
    trace,
)
from hbm.newton import System
from microslip_mechanics.arrays import Array

CONTROL = StepControl(initial=0.05, smallest=1e-5, largest=0.2, tolerance=1e-10)

FOLD = 2.0 / (3.0 * math.sqrt(3.0))
"""parameter of the folds of :func:`cubic`, with either sign"""


def even(point: Array) -> Array:
    """Measure arc length with all components alike."""
    return np.ones_like(point)


def cubic(point: Array) -> tuple[Array, Array]:
    """Return x³ − x − p: folds at x = ±1/√3."""
    x, parameter = point
    return np.array([x**3 - x - parameter]), np.array([[3.0 * x**2 - 1.0, -1.0]])


def circle(point: Array) -> tuple[Array, Array]:
    return np.array([point @ point - 1.0]), 2.0 * point[None]


def line(point: Array) -> tuple[Array, Array]:
    x, parameter = point
    return np.array([x - 2.0 * parameter]), np.array([[1.0, -2.0]])


def bend(point: Array) -> tuple[Array, Array]:
    """Return x − 10 |p|, its corner rounded over a thousandth."""
    x, parameter = point
    root = math.hypot(parameter, 1e-3)
    return np.array([x - 10.0 * root]), np.array([[1.0, -10.0 * parameter / root]])


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
    np.testing.assert_allclose(extremes, [FOLD, -FOLD], atol=0.02)


def test_every_point_of_a_curve_solves_the_system() -> None:
    curve = traced(cubic, np.array([-1.3, -1.0]), 1.0)

    for point in curve:
        assert abs(cubic(point)[0][0]) <= CONTROL.tolerance


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
    _, jacobian = cubic(point)

    along = tangent(jacobian, np.array([0.0, 1.0]), scale)

    assert jacobian @ along == pytest.approx(0.0, abs=1e-14)
    assert np.linalg.norm(along / scale) == pytest.approx(1.0)
    assert along[-1] > 0.0


def test_a_curve_without_a_first_point_says_why() -> None:
    def nowhere(point: Array) -> tuple[Array, Array]:
        x, parameter = point
        return np.array([x**2 + 1.0]), np.array([[2.0 * x, 0.0 * parameter]])

    text = (
        r"^the curve does not go on at parameter 3: "
        r"no step along Newton's direction lowers the residual "
        r"\(residual 1\.0e\+00 after 0 iterations, tolerance 1\.0e-10\); "
        r"more harmonics, more samples or a larger threshold velocity "
        r"make it smoother$"
    )
    with pytest.raises(ContinuationError, match=text):
        next(trace(nowhere, np.array([1e-3, 3.0]), 4.0, metric=even, control=CONTROL))


def broken(point: Array) -> tuple[Array, Array]:
    """Return the line, as far as p = 0.5."""
    residual, jacobian = line(point)
    return (residual if point[-1] < 0.5 else np.array([np.inf])), jacobian


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


@pytest.mark.parametrize(
    ("iterations", "factor"), [(0, 2.0), (4, 1.0), (8, 0.5), (2, math.sqrt(2.0))]
)
def test_a_step_is_scaled_by_how_far_the_iterations_are_from_their_target(
    iterations: int, factor: float
) -> None:
    control = StepControl(initial=0.01, largest=1.0, target_iterations=4)

    assert control.after(0.01, iterations) == pytest.approx(factor * 0.01)


def test_a_step_stays_between_the_smallest_and_the_largest() -> None:
    control = StepControl(initial=0.01, smallest=0.009, largest=0.011)

    assert control.after(0.01, 0) == 0.011
    assert control.after(0.01, 20) == 0.009


@pytest.mark.parametrize(
    ("steps", "text"),
    [
        ((0.0, 0.1, 0.2), "steps 0, 0.1, 0.2: give 0 < smallest <= initial <= largest"),
        ((0.1, 0.05, 0.2), "steps 0.1, 0.05, 0.2: give "),
        ((0.01, 0.5, 0.2), "steps 0.01, 0.5, 0.2: give "),
    ],
)
def test_steps_in_a_wrong_order_are_refused(
    steps: tuple[float, float, float], text: str
) -> None:
    smallest, initial, largest = steps
    with pytest.raises(ValueError, match=f"^{text}"):
        StepControl(smallest=smallest, initial=initial, largest=largest)


def test_a_tolerance_that_cannot_be_met_is_refused() -> None:
    with pytest.raises(ValueError, match=r"^tolerance 0: give a positive one$"):
        StepControl(tolerance=0.0)
