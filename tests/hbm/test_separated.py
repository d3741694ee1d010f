"""Factors by Schur's complement of what couples within one order alone."""

from typing import TypeAlias

import numpy as np
import pytest
from numpy.typing import NDArray

from hbm.continuation import factors
from hbm.continuation.bordered import Bordered
from hbm.continuation.factors import FEWEST, factored
from hbm.continuation.separated import Separated
from microslip_mechanics.arrays import Array

HARMONICS, RANK, FREE = 40, 6, 4
"""of six coordinates four couple no orders"""


Places: TypeAlias = NDArray[np.int64]


def bordered(seed: int) -> tuple[Array, Array, Array, Places, Places]:
    """Return Jacobian, slope, border, orders and coordinates."""
    random = np.random.default_rng(seed)
    terms = np.arange(2 * HARMONICS + 1)
    orders = np.repeat((terms + 1) // 2, RANK)
    coordinates = np.tile(np.arange(RANK), terms.size)
    size = orders.size
    jacobian = random.standard_normal((size, size)) + 3.0 * np.eye(size)
    apart = coordinates < FREE
    alone = apart[:, None] | apart
    jacobian[alone & (orders[:, None] != orders)] = 0.0
    return (
        jacobian,
        random.standard_normal(size),
        random.standard_normal(size + 1),
        orders,
        coordinates,
    )


@pytest.mark.parametrize("seed", range(4))
def test_solutions_and_sign_are_those_of_all_factors(seed: int) -> None:
    jacobian, slope, border, orders, coordinates = bordered(seed)
    right = np.random.default_rng(9).standard_normal((slope.size + 1, 2))

    found = factored(jacobian, slope, border, orders, coordinates)
    whole = Bordered(jacobian, slope, border)

    assert isinstance(found, Separated)
    assert found.sign == whole.sign
    expected = whole.solve(right)
    np.testing.assert_allclose(found.solve(right), expected, atol=1e-9)
    np.testing.assert_allclose(found.solve(right[:, 0]), expected[:, 0], atol=1e-9)


def test_orders_without_such_unknowns_are_left(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(factors, "FEWEST", 100)
    jacobian, slope, border, orders, coordinates = bordered(1)
    kept = (coordinates >= FREE) | (orders % 2 == 1)
    right = np.ones(np.count_nonzero(kept) + 1)
    some = slope[kept], border[np.append(kept, True)]
    matrix = np.ascontiguousarray(jacobian[np.ix_(kept, kept)])

    found = factored(matrix, *some, orders[kept], coordinates[kept])

    assert isinstance(found, Separated)
    expected = Bordered(matrix, *some).solve(right)
    np.testing.assert_allclose(found.solve(right), expected, atol=1e-9)


def test_what_couples_orders_a_little_is_no_rounding() -> None:
    jacobian, slope, border, orders, coordinates = bordered(0)
    for coordinate in range(FREE):
        jacobian[coordinate, coordinate + 3 * RANK] = 1e-6

    found = factored(jacobian, slope, border, orders, coordinates)

    assert isinstance(found, Bordered)


def test_a_block_that_is_singular_by_itself_is_left_to_all_factors() -> None:
    jacobian, slope, border, orders, coordinates = bordered(0)
    block = np.flatnonzero((orders == 7) & (coordinates < FREE))
    jacobian[np.ix_(block, block)] = np.ones((block.size, block.size))

    found = factored(jacobian, slope, border, orders, coordinates)

    assert isinstance(found, Bordered)
    right = np.ones(slope.size + 1)
    matrix = np.vstack([np.column_stack([jacobian, slope]), border])
    np.testing.assert_allclose(matrix @ found.solve(right), right, atol=1e-8)


def test_few_unknowns_are_not_looked_at() -> None:
    jacobian, slope, border, orders, coordinates = bordered(0)
    few = FEWEST - 10
    cut = slice(0, few)

    found = factored(
        jacobian[cut, cut],
        slope[cut],
        np.append(border[cut], 1.0),
        orders[cut],
        coordinates[cut],
    )

    assert isinstance(found, Bordered)
