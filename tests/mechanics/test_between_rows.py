"""What a motion does between the rows of its history."""

import numpy as np
import pytest

from microslip_mechanics.results import between_rows
from microslip_mechanics.results.between_rows import DENSE, largest
from row_motions import bounces, swings


def test_the_largest_values_are_found_with_fourth_and_third_order() -> None:
    steps = np.array([0.4, 0.2, 0.1, 0.05])
    # one turn: each extreme lies somewhere between its two rows
    found = np.array([largest(*swings(each, end=7.0)) for each in steps])
    errors = np.abs(found / [[1.0, 3.0], [1.0, 2.0]] - 1.0)

    assert (errors[:, 0] <= steps[:, None] ** 4 / 384.0).all()
    assert (errors[:, 1] <= steps[:, None] ** 3 / 50.0).all()


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


def test_rest_and_a_single_row_are_as_large_as_they_are() -> None:
    one = np.ones((1, 2))
    np.testing.assert_array_equal(largest(np.zeros(1), one, one), 1.0)
    still = np.zeros((5, 1))
    assert not largest(np.arange(5.0), still, still).any()


def test_what_only_creeps_goes_as_far_as_its_rows() -> None:
    time = np.linspace(0.0, 1.0, 6)
    line = np.stack([time, 2.0 - time], axis=1)
    speed = np.tile([1.0, -1.0], (6, 1))

    np.testing.assert_allclose(largest(time, line, speed), [[1.0, 2.0], [1.0, 1.0]])


@pytest.mark.parametrize(
    "step",
    [
        *(pytest.param(each, marks=pytest.mark.long) for each in (0.02, 0.11)),
        0.045,
        0.2,
    ],
)
def test_no_velocity_is_made_across_impacts(step: float) -> None:
    time, moved, moving = bounces(step)

    _, fast = largest(time, moved, moving)

    assert np.abs(moving).max() <= fast[0] <= 1.0 + 1e-3
