"""The small dense solve against numpy's."""

import numpy as np
import pytest

from timedomain.contact.dense import eliminate

pytestmark = pytest.mark.kernels


@pytest.mark.parametrize("size", [1, 2, 3, 6, 12])
def test_the_solution_is_that_of_numpy(size: int) -> None:
    rng = np.random.default_rng(size)
    matrix, right = rng.standard_normal((size, size)), rng.standard_normal(size)
    expected = np.linalg.solve(matrix, right)

    solution = right.copy()
    regular = eliminate(matrix.copy(), solution)

    assert regular
    # Measured 3e-15 times the condition number's growth.
    rounding = 1e-15 * np.linalg.cond(matrix) * np.abs(expected).max()
    np.testing.assert_allclose(solution, expected, rtol=0.0, atol=10.0 * rounding)


def test_a_zero_on_the_diagonal_is_pivoted_away() -> None:
    matrix = np.array([[0.0, 2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 4.0]])
    solution = np.array([6.0, 5.0, 8.0])

    assert eliminate(matrix, solution)

    np.testing.assert_array_equal(solution, [5.0, 3.0, 2.0])


def test_the_largest_pivot_keeps_a_small_one_from_spoiling_the_solution() -> None:
    matrix = np.array([[1e-18, 1.0], [1.0, 1.0]])
    solution = np.array([1.0, 2.0])

    assert eliminate(matrix, solution)

    np.testing.assert_allclose(solution, [1.0, 1.0], rtol=1e-15)


@pytest.mark.parametrize(
    "matrix",
    [
        np.zeros((1, 1)),
        np.array([[1.0, 2.0], [2.0, 4.0]]),
        np.array([[1.0, 0.0, 3.0], [2.0, 0.0, 1.0], [5.0, 0.0, 4.0]]),
        np.array([[np.nan]]),
    ],
)
def test_a_singular_matrix_is_told(matrix: np.ndarray) -> None:
    assert not eliminate(matrix.copy(), np.ones(len(matrix)))


def test_a_system_without_unknowns_is_solved() -> None:
    assert eliminate(np.zeros((0, 0)), np.zeros(0))
