"""Costs at an error asked for, read off ladders of runs."""

import csv
from pathlib import Path

import numpy as np
import pytest

from benchmarks.work_precision import Run, cost_at, drawn, front, written


def runs(*pairs: tuple[float, float]) -> list[Run]:
    return [
        Run("one", (1e-3,), cost, error, 0.0, success=True) for cost, error in pairs
    ]


def test_a_cost_lies_on_the_power_law_between_two_runs() -> None:
    ladder = runs((1.0, 1e-2), (10.0, 1e-4), (100.0, 1e-6))

    assert cost_at(ladder, 1e-3) == pytest.approx(np.sqrt(10.0))
    assert cost_at(ladder, 1e-4) == pytest.approx(10.0)
    assert cost_at(ladder, 1e-5) == pytest.approx(10.0**1.5)


def test_a_run_that_another_one_beats_does_not_count() -> None:
    ladder = runs((50.0, 2.0), (1.0, 1e-2), (20.0, 2e-2), (10.0, 1e-4), (3.0, np.nan))

    assert [run.cost for run in front(ladder)] == [1.0, 10.0]
    assert cost_at(ladder, 1e-3) == pytest.approx(np.sqrt(10.0))


def test_a_ladder_that_is_better_than_asked_costs_its_first_run() -> None:
    assert cost_at(runs((2.0, 1e-5), (4.0, 1e-7)), 1e-3) == 2.0


def test_a_ladder_that_does_not_reach_an_error_has_no_cost() -> None:
    assert np.isnan(cost_at(runs((1.0, 1e-2), (2.0, 1e-3)), 1e-6))
    assert np.isnan(cost_at([], 1e-3))


def test_table_and_picture_hold_all_runs(tmp_path: Path) -> None:
    ladder = runs((1.0, 1e-2), (10.0, 1e-4))

    written(ladder, tmp_path / "runs.csv")
    drawn(ladder, "two runs", tmp_path / "runs.png")

    with (tmp_path / "runs.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["cost"]) for row in rows] == [1.0, 10.0]
    assert [float(row["error"]) for row in rows] == [1e-2, 1e-4]
    assert (tmp_path / "runs.png").stat().st_size > 1000
