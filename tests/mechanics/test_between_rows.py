"""What a motion does between the rows of its history."""

import numpy as np
import pytest

from microslip_mechanics import between_rows
from microslip_mechanics.arrays import Array
from microslip_mechanics.between_rows import DENSE, largest, rows_error


def swings(step: float, end: float = 40.0) -> tuple[Array, Array, Array]:
    """Return rows of two motions: amplitude 1 about 0, and 2 about 1."""
    time = np.arange(0.013, end, step)
    other = time + 0.3
    moved = np.stack([np.sin(time), 1.0 + 2.0 * np.cos(other)], axis=1)
    moving = np.stack([np.cos(time), -2.0 * np.sin(other)], axis=1)
    return time, moved, moving


def test_the_largest_values_are_found_with_fourth_and_third_order() -> None:
    steps = np.array([0.4, 0.2, 0.1, 0.05])
    # one turn: each extreme lies somewhere between its two rows
    found = np.array([largest(*swings(each, end=7.0)) for each in steps])
    errors = np.abs(found / [[1.0, 3.0], [1.0, 2.0]] - 1.0)

    assert (errors[:, 0] <= steps[:, None] ** 4 / 384.0).all()
    assert (errors[:, 1] <= steps[:, None] ** 3 / 50.0).all()


@pytest.mark.parametrize("step", [0.2, 0.5, 0.9])
def test_the_error_covers_what_rows_miss(step: float) -> None:
    time, moved, moving = swings(step, end=7.0)

    far, _ = largest(time, moved, moving)

    true = np.abs(far - [1.0, 3.0]).max() / 3.0
    assert true <= rows_error(time, moved, moving) < 0.5


def test_histories_may_be_longer_than_a_block(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = largest(*swings(0.4, end=70.0))

    for block in (1, 7, 1000):
        monkeypatch.setattr(between_rows, "BLOCK", block)
        np.testing.assert_array_equal(largest(*swings(0.4, end=70.0)), whole)


def test_sparse_rows_are_taken_as_they_are() -> None:
    time, moved, moving = swings(1.2 * DENSE)

    far, fast = largest(time, moved, moving)

    np.testing.assert_array_equal(far, np.abs(moved).max(axis=0))
    np.testing.assert_array_equal(fast, np.abs(moving).max(axis=0))


def test_rest_and_a_single_row_have_no_error() -> None:
    one = np.ones((1, 2))
    assert rows_error(np.zeros(1), one, one) == 0.0
    np.testing.assert_array_equal(largest(np.zeros(1), one, one), 1.0)
    still = np.zeros((5, 1))
    assert rows_error(np.arange(5.0), still, still) == 0.0
    assert not largest(np.arange(5.0), still, still).any()


def test_what_only_creeps_goes_as_far_as_its_rows() -> None:
    time = np.linspace(0.0, 1.0, 6)
    line = np.stack([time, 2.0 - time], axis=1)
    speed = np.tile([1.0, -1.0], (6, 1))

    np.testing.assert_allclose(largest(time, line, speed), [[1.0, 2.0], [1.0, 1.0]])
