"""The grid of parameters: what it covers, and that a failure is a result."""

from dataclasses import replace

import numpy as np
import pytest

from microslip.cli import main
from microslip.scene_file import load_scene
from microslip.studies.grid import (
    FRICTIONS,
    LAWS,
    LOADS,
    QUICK,
    SIGMAS,
    THRESHOLDS,
    Attempt,
    attempts,
    cases,
    uncovered,
)
from microslip_mechanics.response import ResponseCurve

RIG = load_scene("two-blades")


def test_the_grid_has_each_value_with_each_load() -> None:
    grid = cases(RIG)

    assert len(grid) == len(set(grid)) == 108
    for values, name in (
        (LAWS, "law"),
        (SIGMAS, "sigma"),
        (THRESHOLDS, "threshold"),
        (FRICTIONS, "friction"),
    ):
        for value in values:
            loads = {
                (case.preload, case.drive)
                for case in grid
                if getattr(case, name) == value
            }
            assert loads == set(LOADS)


@pytest.mark.parametrize(
    ("name", "values"),
    [
        ("law", LAWS),
        ("sigma", SIGMAS),
        ("threshold", THRESHOLDS),
        ("friction", FRICTIONS),
        ("drive", {drive for _, drive in LOADS}),
        ("preload", {preload for preload, _ in LOADS}),
    ],
)
def test_a_quick_grid_misses_no_value(name: str, values: set[float]) -> None:
    assert {getattr(case, name) for case in cases(RIG)[::QUICK]} == set(values)


def test_an_attempt_tells_how_it_ended() -> None:
    sticking = replace(cases(RIG)[0], friction=5.0, preload=100.0, drive=0.1)
    impossible = replace(sticking, sigma=-1.0)

    whole, wrong = attempts("two-blades", ("model=A",), [sticking, impossible])

    assert whole.ending == "complete"
    assert whole.points > 10
    assert whole.error < 1e-3
    assert whole.whole
    assert whole.gap == 0.0
    assert wrong.points == 0
    assert not wrong.whole
    assert "[contact] sigma = -1.0" in wrong.ending


@pytest.mark.parametrize(
    ("frequencies", "restarts", "share"),
    [
        ([1.0, 2.0, 1.5, 3.0], [], 0.0),
        ([1.0, 2.0, 1.5, 2.4, 3.0], [3], 0.2),
        ([1.0, 1.6, 1.4, 3.0, 2.0, 1.0], [3], 0.0),
        ([1.0, 1.2, 1.3, 1.5, 1.9, 3.0], [2, 4], 0.25),
        ([1.0, 3.0, 1.5, 2.0, 2.8, 4.0], [2, 4], 0.0),
        ([1.0], [], 0.0),
    ],
    ids=[
        "whole",
        "a gap behind a fold",
        "traced back from its end",
        "two gaps",
        "a piece within another",
        "a point",
    ],
)
def test_a_gap_is_what_no_piece_covers(
    small_curve: ResponseCurve,
    frequencies: list[float],
    restarts: list[int],
    share: float,
) -> None:
    events = tuple(
        "restart" if place in restarts else "" for place in range(len(frequencies))
    )
    curve = replace(small_curve, frequency=np.array(frequencies), event=events)

    assert uncovered(curve) == pytest.approx(share)


@pytest.mark.parametrize(
    ("ending", "gap", "whole"),
    [
        ("complete", 0.0, True),
        ("complete", 0.009, True),
        ("complete", 0.011, False),
        ("interrupted", 0.0, False),
    ],
)
def test_a_whole_curve_comes_to_its_end_without_a_wide_gap(
    ending: str, gap: float, whole: bool
) -> None:
    assert Attempt(cases(RIG)[0], ending, 68, 1e-4, gap, 1.0).whole == whole


@pytest.mark.parametrize("name", ["bladed-disk", "jenkins"])
def test_a_scene_without_these_numbers_is_refused_in_a_line(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["grid", name]) == 2

    output, error = capsys.readouterr()
    assert output == ""
    assert error.startswith("microslip: grid changes the numbers of two blades")
    assert error.count("\n") == 1
