"""Thinned histories: extremes stay, the balance of energies stays."""

import dataclasses
from typing import Any

import numpy as np
import pytest

from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.thinning import thinned
from microslip_mechanics.results.time_history import TimeHistory


def long(history: TimeHistory, rows: int) -> TimeHistory:
    """Return a history of many rows, all different."""
    draw = np.random.default_rng(5)
    none = np.zeros(len(history.time))
    history = dataclasses.replace(
        history, energy_error=none, peak_error=none, work_difference=none
    )
    made: dict[str, Any] = {
        field.name: draw.normal(size=(rows, *values.shape[1:]))
        for field in dataclasses.fields(history)
        if isinstance(values := getattr(history, field.name), np.ndarray)
    }
    return dataclasses.replace(history, **(made | {"time": np.arange(rows) * 0.1}))


def rows_of(history: TimeHistory, rows: slice) -> TimeHistory:
    """Return some rows of a history."""
    made: dict[str, Any] = {
        field.name: values[rows]
        for field in dataclasses.fields(history)
        if isinstance(values := getattr(history, field.name), np.ndarray)
    }
    return dataclasses.replace(history, **made)


@pytest.mark.parametrize("rows", [1, 999, 1000, 1001])
@pytest.mark.parametrize("stride", [1, 10, 2000])
def test_extremes_of_each_stretch_stay(
    rows: int, stride: int, small_history: TimeHistory
) -> None:
    whole = long(small_history, rows)

    few = thinned(whole, stride)

    assert len(few.time) == 2 * -(-rows // stride)
    assert (np.diff(few.time) >= 0.0).all()
    for place in range(0, len(few.time), 2):
        stretch = slice(place // 2 * stride, (place // 2 + 1) * stride)
        for name in ("displacement", "velocity", "normal_force", "friction_power"):
            shown, part = getattr(few, name), getattr(whole, name)[stretch]
            np.testing.assert_array_equal(shown[place], part.min(axis=0))
            np.testing.assert_array_equal(shown[place + 1], part.max(axis=0))
        np.testing.assert_array_equal(few.energy[place], whole.energy[stretch][-1])
    for name in ("energy_error", "peak_error", "work_difference"):
        assert getattr(few, name).shape == few.time.shape
        assert getattr(few, name)[-1] == getattr(whole, name)[-1]
    assert few.time[-1] == whole.time[-1]
    np.testing.assert_allclose(few.closing_error[-1], whole.closing_error[-1])


def test_parts_of_whole_stretches_give_the_same(small_history: TimeHistory) -> None:
    whole = long(small_history, 100)
    empty = dataclasses.replace(whole, frequency=np.zeros(0), level=np.zeros(0))
    parts = [rows_of(empty, slice(0, 40)), rows_of(empty, slice(40, 100))]

    together = joined([thinned(part, 10) for part in parts], "complete")

    expected = thinned(empty, 10)
    np.testing.assert_array_equal(together.displacement, expected.displacement)
    np.testing.assert_array_equal(together.energy, expected.energy)
    assert together.frequency.size == 0
