"""The corrector: its rate, its plane and every way in which it ends."""

import math

import numpy as np
import pytest

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import System
from hbm.continuation.newton import Small, correct
from microslip_mechanics.arrays import Array
from systems import Dense

AT_ITS_PARAMETER = np.array([0.0, 1.0])
"""row that keeps the last component of a point in two unknowns"""


def corrected(
    system: System,
    start: float,
    *,
    max_iterations: int = 15,
    small: Small | None = None,
) -> Correction:
    """Correct one unknown at the parameter 0."""
    return correct(
        system,
        np.array([start, 0.0]),
        AT_ITS_PARAMETER,
        tolerance=1e-12,
        max_iterations=max_iterations,
        small=small,
    )


def root_of_two(point: Array) -> tuple[Array, Dense]:
    x, _ = point
    return np.array([x**2 - 2.0]), Dense([[2.0 * x, 0.0]])


def without_root(point: Array) -> tuple[Array, Dense]:
    x, _ = point
    return np.array([x**2 + 1.0]), Dense([[2.0 * x, 0.0]])


def logarithm(point: Array) -> tuple[Array, Dense]:
    """Return log x, infinite where there is none."""
    x, _ = point
    if x <= 0.0:
        return np.array([np.inf]), Dense([[1.0, 0.0]])
    return np.array([math.log(x)]), Dense([[1.0 / x, 0.0]])


def circle_and_cubic(point: Array) -> tuple[Array, Dense]:
    x, y, z = point
    residual = np.array([x**2 + y**2 - z, y - x**3])
    return residual, Dense([[2 * x, 2 * y, -1.0], [-3 * x**2, 1.0, 0.0]])


def test_the_residual_falls_quadratically() -> None:
    correction = correct(
        circle_and_cubic,
        np.array([1.4, 1.3, 2.0]),
        np.array([0.3, -0.2, 1.0]),
        tolerance=1e-14,
        chord=0.0,
    )

    sizes = np.log(correction.residuals)
    # Each iteration doubles the digits; measured 1.98, a secant method makes 1.6.
    falling = sizes[np.array(correction.residuals) > 1e-14]
    rates = np.diff(falling)[1:] / np.diff(falling)[:-1]
    assert rates[-1] == pytest.approx(2.0, abs=0.2)


def test_factors_serve_again_where_the_residual_falls_fast() -> None:
    asked = []

    def counted(point: Array) -> tuple[Array, Dense]:
        residual, linearised = circle_and_cubic(point)
        asked.append(linearised)
        return residual, linearised

    solved = []
    original = Dense.solve

    def solve(self: Dense, normal: Array, right: Array) -> Array:
        solved.append(self)
        return original(self, normal, right)

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(Dense, "solve", solve)
        correction = correct(
            counted,
            np.array([1.4, 1.3, 2.0]),
            np.array([0.3, -0.2, 1.0]),
            tolerance=1e-12,
        )

    assert correction.outcome is Outcome.CONVERGED
    assert len({id(each) for each in solved}) < len(solved)
    assert correction.linearised is asked[-1]


def test_the_point_stays_in_the_plane_through_the_prediction() -> None:
    predicted, normal = np.array([1.4, 1.3, 2.0]), np.array([0.3, -0.2, 1.0])

    correction = correct(circle_and_cubic, predicted, normal, tolerance=1e-12)

    assert (correction.point - predicted) @ normal == pytest.approx(0.0, abs=1e-14)
    np.testing.assert_allclose(circle_and_cubic(correction.point)[0], 0.0, atol=1e-12)


def test_a_correction_carries_residual_and_derivative_at_its_point() -> None:
    correction = corrected(root_of_two, 1.0)

    assert correction.outcome is Outcome.CONVERGED
    assert correction.point[0] == pytest.approx(math.sqrt(2.0), rel=1e-14)
    residual, derivative = root_of_two(correction.point)
    np.testing.assert_array_equal(correction.residual, residual)
    assert isinstance(correction.linearised, Dense)
    np.testing.assert_array_equal(correction.linearised.rows, derivative.rows)


def test_a_point_on_the_curve_takes_no_iteration() -> None:
    correction = corrected(logarithm, 1.0)

    assert correction.outcome is Outcome.CONVERGED
    assert correction.iterations == 0
    assert correction.residuals == (0.0,)


def test_a_step_that_raises_the_residual_is_halved() -> None:
    # From x = 5 the whole step, x log x, leads out of the logarithm's domain.
    correction = corrected(logarithm, 5.0)

    assert correction.outcome is Outcome.CONVERGED
    assert correction.point[0] == pytest.approx(1.0, rel=1e-12)
    assert np.all(np.diff(correction.residuals) < 0.0)


def test_the_iteration_limit_exhausts_a_correction() -> None:
    correction = corrected(root_of_two, 100.0, max_iterations=3)

    assert correction.outcome is Outcome.EXHAUSTED
    assert correction.iterations == 3


def test_a_correction_stalls_at_a_minimum_of_the_residual() -> None:
    correction = corrected(without_root, 1e-3)

    assert correction.outcome is Outcome.STALLED
    assert correction.iterations == 0
    assert correction.point[0] == 1e-3


@pytest.mark.parametrize(
    ("idle", "outcome", "steps"),
    [
        (None, Outcome.CONVERGED, 7),
        (8, Outcome.CONVERGED, 7),
        (4, Outcome.STALLED, 4),
    ],
)
def test_idle_steps_end_a_correction(
    idle: int | None, outcome: Outcome, steps: int
) -> None:
    def slow_at_first(point: Array) -> tuple[Array, Dense]:
        x, _ = point
        return point[:1], Dense([[100.0 if x > 0.95 else 1.0, 0.0]])

    found = correct(
        slow_at_first,
        np.array([1.0, 0.0]),
        AT_ITS_PARAMETER,
        tolerance=1e-12,
        idle=idle,
    )

    assert (found.outcome, found.iterations) == (outcome, steps)


def test_a_singular_jacobian_ends_a_correction() -> None:
    correction = corrected(without_root, 0.0)

    assert correction.outcome is Outcome.SINGULAR


def test_a_residual_that_is_not_finite_ends_a_correction() -> None:
    correction = corrected(logarithm, -1.0)

    assert correction.outcome is Outcome.OVERFLOW
    assert correction.residuals == (np.inf,)


def test_a_residual_whose_square_overflows_is_lowered_without_a_warning() -> None:
    def system(point: Array) -> tuple[Array, Dense]:
        return np.array([1e200 * (point[0] - 1.0)]), Dense([[1e200, 0.0]])

    start, normal = np.array([3.0, 0.0]), np.array([0.0, 1.0])
    found = correct(system, start, normal, tolerance=1e-9)

    assert found.outcome is Outcome.CONVERGED


def test_a_system_without_unknowns_is_solved_where_it_stands() -> None:
    def nothing(_: Array) -> tuple[Array, Dense]:
        return np.zeros(0), Dense(np.zeros((0, 1)))

    correction = correct(nothing, np.array([3.0]), np.array([1.0]), tolerance=1e-12)

    assert correction.outcome is Outcome.CONVERGED
    assert correction.point[0] == 3.0


def within(changes: float, residual: float) -> Small:
    """Return what does not matter: small changes where the residual is small."""
    return Small(lambda _: np.array([changes, changes]), residual)


def test_a_step_that_does_not_matter_is_the_last_one() -> None:
    exact = corrected(root_of_two, 3.0)
    steps = np.abs(np.diff(points_of(exact.iterations)))
    rough = corrected(root_of_two, 3.0, small=within(1.01 * steps[3], 1.0))

    assert rough.outcome is Outcome.CONVERGED
    assert rough.iterations == 4
    assert rough.residuals == exact.residuals[:5]
    assert rough.residuals[-1] > 1e-14


def points_of(iterations: int) -> Array:
    """Return Newton's points on the way to the root of two from 3."""
    points = [3.0]
    for _ in range(iterations):
        points.append(0.5 * (points[-1] + 2.0 / points[-1]))
    return np.array(points)


def test_a_small_step_far_from_balance_does_not_end_a_correction() -> None:
    exact = corrected(root_of_two, 3.0)

    rough = corrected(root_of_two, 3.0, small=within(10.0, 1e-13))

    assert rough.residuals == exact.residuals


def jumping(height: float) -> System:
    """Return a line whose residual jumps by ``height`` where it would vanish."""

    def system(point: Array) -> tuple[Array, Dense]:
        jump = math.copysign(0.5 * height, point[0] - 1.0)
        return np.array([point[0] - 1.0 + jump]), Dense(np.array([[1.0, 0.0]]))

    return system


@pytest.mark.parametrize(
    ("small", "outcome"),
    [
        (within(1e-3, 1e-2), Outcome.CONVERGED),
        (within(1e-4, 1e-2), Outcome.STALLED),
        (within(1e-3, 1e-3), Outcome.STALLED),
        (None, Outcome.STALLED),
    ],
)
def test_a_jump_is_passed_only_if_neither_step_nor_residual_matters(
    small: Small | None, outcome: Outcome
) -> None:
    # No point has a residual below 2.5e-3; ten times the small change may be left.
    system = jumping(5e-3)

    found = correct(
        system, np.array([1.2, 0.0]), np.array([0.0, 1.0]), tolerance=1e-12, small=small
    )

    assert found.outcome is outcome
    assert found.point[0] == pytest.approx(1.0, abs=6e-3)
