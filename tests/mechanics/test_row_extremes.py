"""Extremes of histories, and what their rows may miss of them."""

import numpy as np
import pytest

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.extremes import extremes, of_all
from microslip_mechanics.results.time_history import TimeHistory
from row_motions import swings


def history(
    time: Array, moved: Array, moving: Array, normal: Array | None = None
) -> TimeHistory:
    """Return a history of some rows."""
    rows, none = len(time), np.zeros((len(time), 0))
    force = none if normal is None else normal
    names = tuple(f"{place}" for place in range(moved.shape[1]))
    points = tuple(f"{place}" for place in range(force.shape[1]))
    return TimeHistory(
        *(time, names, moved, moving, points, force, np.zeros(rows), (), none),
        *(0.0, 1.0, 0, 0),
    )


def pushes(step: float, start: float) -> TimeHistory:
    """Return rows of pushes of 1 that last one radian, and of a spring's sine."""
    time = np.arange(start, 40.0, step)
    pulse = np.maximum(np.sin(np.pi * (time % 4.0)) * (time % 4.0 < 1.0), 0.0)
    still = np.zeros((time.size, 1))
    return history(time, still, still, np.stack([pulse, -0.2 * np.sin(time)], axis=1))


@pytest.mark.parametrize("step", [0.2, 0.5, 0.9])
def test_the_error_covers_what_rows_miss(step: float) -> None:
    time, moved, moving = swings(step, end=7.0)

    found = extremes(history(time, moved, moving))

    far, fast = np.abs(found.largest - [[1.0, 3.0], [1.0, 2.0]])
    assert far.max() / 3.0 <= found.errors[0] < 0.5
    assert fast.max() / 2.0 <= found.errors[1] < 0.5


@pytest.mark.parametrize("step", [0.05, 0.1, 0.3, 0.45, 0.9])
@pytest.mark.parametrize("start", [0.01, 0.17])
def test_the_force_error_covers_what_rows_miss(step: float, start: float) -> None:
    found = extremes(pushes(step, start))

    most = float(found.normal[1, 0])
    assert found.normal[0, 0] == 0.0 == found.bent[0, 0]
    assert 1.0 - most <= found.force_error * most + 1e-3
    assert found.force_error <= max(2.0 * step**2, 0.3)


def test_rest_and_a_single_row_have_no_error() -> None:
    one, still = np.ones((1, 2)), np.zeros((5, 1))

    for rows in ((np.zeros(1), one, one, one), (np.arange(5.0), still, still, still)):
        found = extremes(history(*rows))
        assert not found.errors.any()
        assert found.force_error == 0.0


def test_a_history_has_the_extremes_of_its_parts() -> None:
    rows = swings(0.4, end=70.0)
    whole = history(*rows, rows[1])

    parts = [
        history(*(each[first : first + 26] for each in (*rows, rows[1])))
        for first in range(0, len(rows[0]) - 6, 20)
    ]

    for name in ("largest", "halves", "normal", "bent"):
        np.testing.assert_allclose(
            getattr(of_all([extremes(each) for each in parts]), name),
            getattr(extremes(whole), name),
            rtol=1e-12,
        )
