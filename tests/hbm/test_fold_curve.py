"""Folds along a second parameter: closed forms, and folds of whole curves."""

import functools
import itertools
import math
from collections.abc import Callable

import numpy as np
import pytest

from hbm.balance.linearisation import Linearisation
from hbm.continuation.continuation import trace
from hbm.continuation.segment import Segment, folds
from hbm.continuation.step_control import StepControl
from hbm.curves.fold_curve import FoldPoint, meeting
from hbm.curves.parameter_curves import fold_curve
from hbm.errors import ContinuationError
from hbm.events.fold_balance import FoldBalance
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import cubic_oscillator

DAMPING = 0.2
CUSP = (math.sqrt(3.0) * DAMPING + math.sqrt(3.0 * DAMPING**2 + 4.0)) / 2.0
"""frequency [rad/s] at which both folds of one harmonic meet: ω² − 1 = √3 d ω"""


def driven(drive: float) -> Problem:
    return cubic_oscillator(damping=DAMPING, drive=drive)


def located(
    problem: Problem, lowest: float, highest: float, harmonics: int, samples: int
) -> list[PeriodicResponse]:
    """Return the folds of a curve between two frequencies [rad/s]."""
    options = CurveOptions(lowest, highest, harmonics=harmonics, samples=samples)
    curve = frequency_response(problem, static_equilibrium(problem), options)
    return [response for response in curve if response.event == "fold"]


@functools.cache
def tracked() -> list[FoldPoint]:
    """Return Duffing's upper fold in one harmonic from the drive 1 until it is back."""
    upper = located(driven(1.0), 0.5, 3.0, 1, 1024)[0]
    options = CurveOptions(1.0, 0.05, harmonics=1, samples=1024)
    return list(fold_curve(driven, upper, options))


def drives(frequency: float) -> list[float]:
    """Return the drives whose curves fold at a frequency, in one harmonic.

    With A the square of the amplitude and p = 1 − ω² the curve is
    F² = A ((p + ¾A)² + d²ω²); it folds where ∂F²/∂A = 0.
    """
    linear, damped = 1.0 - frequency**2, (DAMPING * frequency) ** 2
    squares = np.roots([27.0 / 16.0, 3.0 * linear, linear**2 + damped]).real
    return [
        math.sqrt(each * ((linear + 0.75 * each) ** 2 + damped)) for each in squares
    ]


def test_the_folds_of_the_cubic_spring_are_those_of_the_amplitude_equation() -> None:
    points = tracked()

    assert len(points) > 30
    for point in points:
        found = point.response
        misses = [abs(found.parameter - each) for each in drives(found.frequency)]
        # The contacts' force is sampled; measured 3e-9.
        assert min(misses) < 1e-7 * found.parameter


@pytest.mark.long
def test_a_fold_ends_at_the_range_where_there_is_no_problem_beyond() -> None:
    def damped(damping: float) -> Problem:
        assert 0.0 <= damping <= DAMPING
        return cubic_oscillator(damping=damping, drive=1.0)

    lower = located(damped(DAMPING), 0.5, 3.0, 1, 1024)[1]
    options = CurveOptions(DAMPING, 0.0, harmonics=1, samples=1024)
    points = [point.response for point in fold_curve(damped, lower, options)]

    # undamped, ω² = 1 + ¾A² + F/A is least at A³ = 2F/3
    amplitude = (2.0 / 3.0) ** (1.0 / 3.0)
    fold = math.sqrt(1.0 + 0.75 * amplitude**2 + 1.0 / amplitude)
    assert points[-1].parameter == 0.0
    assert points[-1].frequency == pytest.approx(fold, rel=1e-7)


def test_both_folds_of_the_cubic_spring_meet_at_its_cusp() -> None:
    meetings = [point.response for point in tracked() if point.response.event]

    assert [point.event for point in meetings] == ["cusp"]
    found = meetings[0]
    expected = math.sqrt(32.0 / 81.0 * (CUSP**2 - 1.0) ** 3)
    # located to 1e-5 of a step, at which the drive is flat
    assert found.parameter == pytest.approx(expected, rel=1e-6)
    assert found.frequency == pytest.approx(CUSP, rel=1e-5)


def test_beyond_the_cusp_the_fold_comes_back_as_the_other_one() -> None:
    upper, lower = located(driven(1.0), 0.5, 3.0, 1, 1024)
    first, last = tracked()[0].response, tracked()[-1].response

    assert first.parameter == last.parameter == 1.0
    assert first.frequency == pytest.approx(upper.frequency, rel=1e-8)
    assert last.frequency == pytest.approx(lower.frequency, rel=1e-8)


def test_a_fold_has_one_multiplier_at_one_and_the_other_inside() -> None:
    upper = located(driven(1.0), 0.5, 3.0, 9, 1024)[0]
    options = CurveOptions(1.0, 0.7, harmonics=9, samples=1024)

    points = list(fold_curve(driven, upper, options))

    assert points[-1].response.parameter == 0.7
    for point in points:
        own, other = sorted(point.response.multipliers, key=lambda each: abs(each - 1))
        assert own == pytest.approx(1.0, abs=1e-4)
        # Both shrink volumes like the damping.
        period = math.tau / point.response.frequency
        assert other == pytest.approx(math.exp(-DAMPING * period), rel=1e-3)
        assert point.unstable == 0


def test_the_stated_error_covers_what_more_harmonics_change() -> None:
    upper = located(driven(1.0), 0.5, 3.0, 1, 1024)[0]
    better = located(driven(1.0), 0.5, 3.0, 9, 1024)[0]
    point = next(fold_curve(driven, upper, CurveOptions(1.0, 0.9, harmonics=1)))

    change = abs(better.frequency / point.response.frequency - 1.0)
    assert 0.4 * point.frequency_error < change < point.frequency_error


@pytest.mark.long
@pytest.mark.slow
def test_folds_of_whole_curves_lie_on_the_tracked_folds_of_the_rig() -> None:
    def problem_at(force: float) -> Problem:
        return rig_problem(model="A", friction__law="gkf", excitation__force=force)

    lowest, highest, resolution = math.tau * 135.6, math.tau * 137.2, (15, 512)
    begins, ends = (
        located(problem_at(force), highest, lowest, *resolution)[:2]
        for force in (1.8, 1.7)
    )
    options = CurveOptions(1.8, 1.7, harmonics=15, samples=512)

    assert len(begins) == 2
    for begun, ended in zip(begins, ends, strict=True):
        points = list(fold_curve(problem_at, begun, options))

        assert points[-1].response.parameter == 1.7
        assert abs(ended.frequency / begun.frequency - 1.0) > 1e-4
        first, last = points[0].response, points[-1].response
        assert first.frequency == pytest.approx(begun.frequency, rel=1e-7)
        assert last.frequency == pytest.approx(ended.frequency, rel=1e-7)


def test_a_response_that_is_far_from_a_fold_is_refused() -> None:
    problem = driven(0.05)
    options = CurveOptions(0.5, 0.6, harmonics=1, samples=64)
    start = next(frequency_response(problem, static_equilibrium(problem), options))

    with pytest.raises(ContinuationError, match="no response is found"):
        next(fold_curve(driven, start, CurveOptions(0.05, 0.04, harmonics=1)))


def ring(parameter: float) -> Callable[[Array], tuple[Array, Linearisation]]:
    """Return y² + ω² = λ: a closed curve that is born at λ = 0."""

    def balance(point: Array) -> tuple[Array, Linearisation]:
        slopes = 2.0 * point
        made = Linearisation(
            lambda: (slopes[:1, None], slopes[1:]), np.zeros(1, dtype=np.int64), 2
        )
        return np.array([point @ point - parameter]), made

    return balance


def test_a_fold_runs_around_the_birth_of_a_closed_curve() -> None:
    system = FoldBalance(ring, lambda _: 1.0, np.zeros(1, dtype=np.int64), 0)
    control = StepControl(tolerance=1e-10)
    points = list(
        trace(
            system,
            np.array([0.01, 1.1, 1.0]),
            -1.0,
            metric=np.ones_like,
            control=control,
            settler=system,
        )
    )

    turns = [
        (segment.locate(folds), meeting(*pair))
        for pair in itertools.pairwise(points)
        for segment in [Segment(system, *pair, np.ones(3), control.tolerance)]
    ]

    (found,) = [(at, kind) for at, kind in turns if at is not None]
    assert found[1] == "isola"
    np.testing.assert_allclose(found[0].point, 0.0, atol=1e-5)
    # to the tolerance of the residual: y² + ω² − λ, and 2 y times the vibration |y|
    assert abs(points[-1].point[0]) < 1e-5
    np.testing.assert_allclose(points[-1].point[1:], [-1.0, 1.0], atol=1e-9)
