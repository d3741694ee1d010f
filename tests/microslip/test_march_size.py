"""Marches that would not end are refused before they begin, in one line."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import pytest
import scipy.sparse

from microslip.scenes.quantity import SceneError
from microslip.studies.march_size import demand_end, turns
from microslip_mechanics.loads.excitation import SweptSine
from timedomain.options import MarchOptions

Run: TypeAlias = Callable[..., tuple[int, str, str]]

SWEEP = SweptSine(0.0, 0.0, 30.0, 32.0, 4.0, 7.0)
FORCE = "0 0\n1e9 1\n"


@pytest.mark.usefixtures("no_hang")
@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("sweep", "sweep.highest=1e12"), "takes 3.1e+12 steps"),
        (("sweep", "march.time_step=1e-9", "march.store_every=1"), "3.2e+10 steps"),
        (("sweep", "sweep.duration=1e8", "march.store_every=1"), "2e+11 steps"),
        (("dwell", "march.time_step=1e-15"), "takes 1e+18 steps"),
        (("decay", "march.time_step=1e-15"), "takes 1e+18 steps"),
    ],
)
def test_a_march_that_would_not_end_is_refused(
    words: tuple[str, ...], told: str, run: Run
) -> None:
    command, *overrides = words
    driven = () if command == "sweep" else ("--frequency", "5")

    status, output, error = run(
        command, "duffing", *driven, *(f"--set={each}" for each in overrides)
    )

    assert (status, output) == (2, "")
    (line,) = error.splitlines()
    assert told in line
    assert "may take 1e+10: give a longer march.time_step" in line


@pytest.mark.usefixtures("no_hang")
def test_a_force_of_thirty_years_is_refused(run: Run) -> None:
    Path("force.txt").write_text(FORCE)
    _, text, _ = run("scenes", "duffing")
    Path("long.toml").write_text(
        text.replace("[sweep]", '[sweep]\nforce_file = "force.txt"')
    )

    status, _, error = run("sweep", "long.toml")

    assert status == 2
    assert "a march of 1e+09 s" in error
    assert "a shorter sweep or force" in error


def test_a_dwell_of_long_periods_must_fit_the_memory(run: Run) -> None:
    few = (
        "--most-periods=1",
        "--set=march.time_step=1e-6",
        "--set=march.store_every=1",
    )

    status, _, error = run("dwell", "duffing", "--frequency", "1e-3", *few)

    assert status == 2
    assert "takes 1e+09 rows in memory, and may take 1e+07" in error


@pytest.mark.parametrize(
    ("command", "words", "key"),
    [
        ("sweep", ("--set=sweep.highest=1e308",), "[sweep] highest = 1e+308"),
        ("sweep", ("--set=march.time_step=1e-300",), "[march] time_step = 1e-300"),
        ("sweep", ("--set=sweep.duration=1e300",), "[sweep] duration = 1e+300"),
        ("frc", ("--set=drive.x=1e300",), "[drive] x: amplitude = 1e+300"),
        ("frc", ("--set=structure.mass=[1e300]",), "mass holds 1e+300 in row 1"),
        ("dwell", ("--frequency", "1e-300"), "--frequency: 1e-300 is out of range"),
    ],
)
def test_numbers_that_overflow_are_refused_by_name(
    command: str, words: tuple[str, ...], key: str, run: Run
) -> None:
    status, output, error = run(command, "duffing", *words)

    assert (status, output) == (2, "")
    (line,) = error.splitlines()
    assert key in line


def test_a_tolerance_needs_a_step_for_each_row_alone() -> None:
    fixed = MarchOptions(1e-9, 1000)

    demand_end(SWEEP, MarchOptions(1e-9, 1000, 1e-3), "give less")
    with pytest.raises(SceneError, match=r"takes 3\.2e\+10 steps.*: give less"):
        demand_end(SWEEP, fixed, "give less")


def test_rows_that_a_file_cannot_count_are_refused() -> None:
    options = MarchOptions(1e-8, 1)

    demand_end(SWEEP, options, "give less", stored=False)
    with pytest.raises(SceneError, match="stored rows"):
        demand_end(SWEEP, options, "give less")


def test_the_drive_of_a_sweep_turns_as_often_as_its_frequency_says() -> None:
    # 2 s of 7 Hz follow 3 Hz / ln(7/4) for 30 s
    assert turns(SWEEP) == pytest.approx(14.0 + 30.0 * 3.0 / 0.5596157879, rel=1e-9)


@pytest.mark.parametrize("command", [("verify",), ("precision", "--quick")])
def test_a_sparse_structure_is_refused_before_its_curve_is_traced(
    command: tuple[str, ...], run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def untraced(*_: object) -> None:
        raise AssertionError("traced")

    monkeypatch.setattr("microslip.studies.curve.trace_curve", untraced)
    monkeypatch.setattr("microslip.studies.precision.case.trace_curve", untraced)
    one = scipy.sparse.eye_array(401, format="csc")
    scipy.sparse.save_npz(tmp_path / "m.npz", one)
    (tmp_path / "large.toml").write_text(
        'scene = "system"\n[structure]\nmass = "m.npz"\nstiffness = "m.npz"\n'
        'mass_damping = 0.1\n[drive]\n"7" = 1\n[probes]\nx = "7"\n'
        "[curve]\nlowest = 0.1\nhighest = 0.2\n"
        "[sweep]\nend = 1\nduration = 1\nlowest = 0.1\nhighest = 0.2\n"
        "[march]\ntime_step = 0.01\n"
    )

    status, _, error = run(command[0], "large.toml", *command[1:])

    assert status in (1, 2)
    assert error.startswith("microslip: the structure is sparse, ")
    assert "[structure.reduction]" in error
    assert error.count("\n") == 1
