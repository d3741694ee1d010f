"""The grid of parameters: what it covers, and that a failure is a result."""

from dataclasses import replace

import pytest

from microslip.cli import main
from microslip.scenes.scene_file import load_scene
from microslip.studies.grid import (
    FRICTIONS,
    LAWS,
    LOADS,
    QUICK,
    SIGMAS,
    THRESHOLDS,
    attempts,
    cases,
)

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

    whole, wrong = attempts(
        "two-blades", ("model=A",), [sticking, impossible], seconds=60.0, processes=1
    )

    assert whole.ending == "complete"
    assert whole.points > 10
    assert whole.error < 1e-3
    assert whole.whole
    assert whole.gap == 0.0
    assert wrong.points == 0
    assert not wrong.whole
    assert "[contact] sigma = -1.0" in wrong.ending


def test_a_curve_ends_where_its_time_does_and_keeps_its_points() -> None:
    slow = replace(cases(RIG)[0], threshold=1e-6, friction=0.3, preload=1.0, drive=1.0)

    (late,) = attempts("two-blades", ("model=A",), [slow], seconds=0.3, processes=1)

    assert late.ending == "out of time after 0.3 s"
    assert not late.whole
    assert late.points > 0
    assert 0.01 < late.gap < 1.0
    assert 0.3 <= late.seconds < 3.0


@pytest.mark.parametrize("name", ["bladed-disk", "jenkins"])
def test_a_scene_without_these_numbers_is_refused_in_a_line(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["grid", name]) == 2

    output, error = capsys.readouterr()
    assert output == ""
    assert error.startswith("microslip: grid changes the numbers of two blades")
    assert error.count("\n") == 1


def test_an_override_of_what_the_grid_varies_is_refused(
    capsys: pytest.CaptureFixture[str],
) -> None:
    sets = ["--set", "model=A", "--set", "friction.law=none"]

    assert main(["grid", "two-blades", *sets]) == 2
    output, error = capsys.readouterr()
    assert output == ""
    assert error == (
        "microslip: --set friction.law=none: grid gives friction.law its own values: "
        "leave it out\n"
    )
