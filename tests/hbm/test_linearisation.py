"""The bordered solution against dense algebra."""

import numpy as np
import pytest

from hbm.balance.linearisation import Linearisation
from hbm.continuation.linearised import SingularError

SIZE = 9
PLACES = np.array([0, 2, 3, 6])
"""of four unknowns in a point of nine components"""


def drawn() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return a Jacobian, a slope and a normal."""
    draw = np.random.default_rng(1)
    return draw.normal(size=(4, 4)), draw.normal(size=4), draw.normal(size=SIZE)


@pytest.mark.parametrize("several", [(), (1,), (3,)])
def test_solutions_are_those_of_the_bordered_matrix(several: tuple[int, ...]) -> None:
    jacobian, slope, normal = drawn()
    right = np.random.default_rng(2).normal(size=(SIZE, *several))
    kept, before = right.copy(), jacobian.copy()

    found = Linearisation(lambda: (jacobian, slope), PLACES, SIZE).solve(normal, right)

    places = np.append(PLACES, SIZE - 1)
    bordered = np.vstack([np.column_stack([jacobian, slope]), normal[places]])
    expected = np.zeros_like(right)
    expected[places] = np.linalg.solve(bordered, right[places])
    np.testing.assert_allclose(found, expected, rtol=0.0, atol=1e-13)
    np.testing.assert_array_equal(right, kept)
    np.testing.assert_array_equal(jacobian, before)


@pytest.mark.parametrize("seed", range(6))
def test_the_orientation_is_the_sign_of_the_determinant(seed: int) -> None:
    draw = np.random.default_rng(seed)
    jacobian, slope = draw.normal(size=(4, 4)), draw.normal(size=4)
    normal, right, unit = draw.normal(size=SIZE), draw.normal(size=SIZE), np.eye(SIZE)
    linearised = Linearisation(lambda: (jacobian, slope), PLACES, SIZE)
    assert linearised.orientation(normal) == 0.0  # nothing is factored yet
    linearised.solve(normal, right)

    tangent = linearised.solve(draw.normal(size=SIZE), unit[-1])

    rows = np.column_stack([jacobian, slope])
    places = np.append(PLACES, SIZE - 1)
    expected = np.linalg.slogdet(np.vstack([rows, tangent[places]])).sign
    assert linearised.orientation(tangent) == expected
    assert linearised.orientation(-tangent) == -expected


@pytest.mark.parametrize("size", [1.0, 3e17, 3e-17])
def test_another_border_may_be_of_any_size(size: float) -> None:
    jacobian, slope, normal = drawn()
    linearised = Linearisation(lambda: (jacobian, slope), PLACES, SIZE)
    right = np.zeros(SIZE)
    right[-1] = 1.0
    linearised.solve(normal, right)
    other = np.random.default_rng(3).normal(size=SIZE)

    found = linearised.solve(size * other, right)

    expected = Linearisation(lambda: (jacobian, slope), PLACES, SIZE).solve(
        other, right
    )
    np.testing.assert_allclose(size * found, expected, rtol=1e-10)


def test_a_border_across_a_fold_has_a_solution() -> None:
    jacobian, slope, _ = drawn()
    jacobian[3] = jacobian[2]
    normal = np.zeros(SIZE)
    normal[PLACES] = np.linalg.svd(jacobian)[2][-1]
    right = np.zeros(SIZE)
    right[-1] = 1.0

    along = Linearisation(lambda: (jacobian, slope), PLACES, SIZE).solve(normal, right)

    assert along @ normal == pytest.approx(1.0)
    assert along[-1] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("value", [0.0, np.nan, np.inf])
def test_what_has_no_solution_is_singular(value: float) -> None:
    _, slope, normal = drawn()
    linearised = Linearisation(lambda: (np.full((4, 4), value), slope), PLACES, SIZE)

    with pytest.raises(SingularError):
        linearised.solve(normal, np.ones(SIZE))


def test_without_unknowns_the_parameter_alone_is_solved_for() -> None:
    linearised = Linearisation(lambda: (np.zeros((0, 0)), np.zeros(0)), PLACES[:0], 3)

    found = linearised.solve(np.array([0.0, 0.0, 2.0]), np.array([5.0, 5.0, 3.0]))

    np.testing.assert_array_equal(found, [0.0, 0.0, 1.5])


def test_what_is_forgotten_is_made_anew() -> None:
    jacobian, slope, normal = drawn()
    made = []

    def make() -> tuple[np.ndarray, np.ndarray]:
        made.append(True)
        return jacobian, slope

    linearised = Linearisation(make, PLACES, SIZE)
    right = np.arange(float(SIZE))
    before = linearised.solve(normal, right)
    linearised.solve(normal, 2.0 * right)
    assert len(made) == 1

    linearised.forget()

    np.testing.assert_array_equal(linearised.solve(normal, right), before)
    assert len(made) == 2
