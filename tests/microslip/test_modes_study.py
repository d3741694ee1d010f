"""Modes against amplitude, and the command that draws them."""

import csv
import math
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

from hbm.modes import ModeOptions, NonlinearMode
from microslip.cli import main
from microslip.studies.modes import followed
from rigs import rig_problem

RANGE = (800.0, 900.0)
FEW = ["--harmonics", "5", "--amplitudes", "0.1", "0.34"]


def test_the_command_writes_a_table_and_a_picture(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["modes", "two-blades", "--set", "model=A", *FEW]

    status = main([*words, "-o", str(tmp_path / "modes")])

    assert status == 0
    assert "most damped" in capsys.readouterr().out
    assert (tmp_path / "modes.png").stat().st_size > 10_000
    with (tmp_path / "modes.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert float(rows[0]["frequency_hz"]) == pytest.approx(134.978, abs=1e-3)
    assert float(rows[-1]["damping_ratio"]) > 1.2 * float(rows[0]["damping_ratio"])


def test_an_interrupted_mode_keeps_what_it_has() -> None:
    def stops(points: Iterable[NonlinearMode]) -> Iterator[NonlinearMode]:
        for count, point in enumerate(points):
            if count == 3:
                raise KeyboardInterrupt
            yield point

    options = ModeOptions(1e-5, 1e-2, harmonics=3)

    (mode,) = followed(rig_problem(model="A"), RANGE, options, stops)

    assert mode.ending == "interrupted"
    assert len(mode.points) == 3


@pytest.mark.parametrize(
    ("words", "status", "hint"),
    [
        (["--harmonics", "0"], 2, "1 to 127"),
        (["--amplitudes", "2", "1"], 2, "smaller one first"),
        (["--range", "140", "130"], 2, "lower frequency first"),
        (["--range", "140", "141"], 1, "another --range"),
        (["--set", "model=C"], 2, "full, B, A"),
    ],
)
def test_what_makes_no_sense_is_refused_in_one_line(
    words: list[str], status: int, hint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["modes", "two-blades", *words]) == status
    printed = capsys.readouterr().err
    assert hint in printed
    assert printed.count("\n") == 1


def test_two_modes_in_a_range_are_both_followed() -> None:
    problem = rig_problem(model="A", friction__law="none")

    modes = list(followed(problem, RANGE, ModeOptions(1e-5, 1e-4, harmonics=3)))

    assert len(modes) == 2
    for mode in modes:
        assert mode.ending == "complete"
        hertz = mode.points[-1].frequency / math.tau
        assert hertz == pytest.approx(136.836, abs=1e-3)
