"""Modes against amplitude, and the command that draws them."""

import csv
import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import microslip
from hbm.errors import ContinuationError
from hbm.modes.linear_modes import LinearMode
from hbm.modes.mode_options import ModeOptions
from hbm.modes.modes import NonlinearMode, nonlinear_mode
from microslip.cli import main
from microslip.commands.modes_tables import ending_of, mode_table
from microslip.figures.modes import modes_figure
from microslip.mode_lines import mode_lines
from microslip.studies import mode_beginning, modes
from microslip.studies.modes import FollowedMode, followed
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from rigs import rig_problem

RANGE = (800.0, 900.0)
TWO = ["--set", "friction.law=none", "--range", "127.3", "143.3"]
FEW = ["--harmonics", "5", "--amplitudes", "0.1", "0.34"]


def two_modes(folder: Path, capsys: pytest.CaptureFixture[str]) -> tuple[int, str, str]:
    """Return status and output of the command for two modes of model A."""
    few = ["--harmonics", "3", "--amplitudes", "0.1", "0.12"]
    words = ["modes", "two-blades", "--set", "model=A", *TWO, *few]
    status = main([*words, "-o", str(folder / "modes")])
    return status, *capsys.readouterr()


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


def _coupled(coupling: float) -> Problem:
    """Return two equal masses, of which one has a cubic spring."""
    return microslip.system(
        mass=[1.0, 1.0],
        stiffness=[[1e3, coupling], [coupling, 1e3]],
        damping_ratio=0.01,
        elements=[
            microslip.Element(
                microslip.CubicSpring(5e7), between=("x2", "ground"), name="cubic"
            )
        ],
    )


@pytest.mark.parametrize(("coupling", "apart"), [(1.0, False), (1e-4, True)])
def test_a_mode_that_begins_as_another_motion_is_told(
    coupling: float, *, apart: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(mode_beginning, "SMALLER", 0)
    options = ModeOptions(1e-5, 1.1e-5, harmonics=3)

    found = list(followed(_coupled(coupling), (30.0, 33.0), options))

    assert [mode.apart for mode in found] == [apart] * 2
    for mode in found:
        said = "begin with smaller --amplitudes"
        assert (said in mode_table(mode, "in small motions")[-1]) == apart


def test_a_mode_begins_where_it_is_the_linear_one() -> None:
    # at 0.01 mm the cubic spring stiffens by 0.004 N/m, more than a weak coupling
    options = ModeOptions(1e-5, 1e-2, harmonics=1)

    soft, hard = followed(_coupled(1e-4), (30.0, 33.0), options)

    assert not soft.apart
    assert not hard.apart
    assert hard.points[0].amplitude < 0.2 * options.smallest
    ends = [mode.points[-1].frequency for mode in (soft, hard)]
    # of one harmonic: k + 3/4 of the cubic force over the amplitude
    amplitude = np.hypot(*hard.points[-1].coefficients[1:3, 1])
    stiff = 1e3 + 0.75 * 5e7 * amplitude**2
    assert ends[0] == pytest.approx(np.sqrt(1e3), rel=1e-4)
    assert ends[1] == pytest.approx(np.sqrt(stiff), rel=1e-4)


def test_harmonics_follow_from_a_tolerance(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["modes", "jenkins", "--amplitudes", "0.15", "0.4"]

    for name, more in (("asked", []), ("fixed", ["--harmonics=15"])):
        assert main([*words, *more, "-o", str(tmp_path / name)]) == 0

    said = capsys.readouterr().out
    assert " points with 3 to 15 harmonics and 64 to 512 samples; " in said
    asked, fixed = (columns(tmp_path / f"{name}.csv") for name in ("asked", "fixed"))
    assert asked["damping_error"].max() <= 1e-2
    known = np.interp(
        asked["amplitude_m"], fixed["amplitude_m"], fixed["damping_ratio"]
    )
    assert known.max() > 15.0 * known.min()
    np.testing.assert_allclose(asked["damping_ratio"], known, rtol=2e-2)


def columns(path: Path) -> dict[str, Array]:
    """Return the columns of a table."""
    with path.open(encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file)
    return dict(zip(names, np.array(rows, dtype=float).T, strict=True))


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


def test_points_that_are_hardly_known_do_not_widen_the_picture() -> None:
    problem, options = rig_problem(model="A"), ModeOptions(1e-5, 1e-2, harmonics=3)
    (mode,) = followed(problem, RANGE, options, lambda points: islice(points, 5))
    points = (replace(mode.points[0], frequency_error=0.5), *mode.points[1:])

    (line,) = mode_lines([replace(mode, points=points)])

    assert line.error < 1e-3


@pytest.mark.parametrize(
    ("words", "status", "hint"),
    [
        (["--amplitudes", "2", "1"], 2, "smaller one first"),
        (["--range", "140", "130"], 2, "lower frequency first"),
        (["--range", "140", "141"], 2, "give another range"),
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


def test_a_mode_without_a_first_point_leaves_the_others(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun: list[object] = []

    def lost(*arguments: object) -> Iterator[NonlinearMode]:
        begun.append(arguments)
        if len(begun) == 2:
            raise ContinuationError("no first point: try less")
        yield from nonlinear_mode(*arguments)  # type: ignore[arg-type]

    for module in (mode_beginning, modes):
        monkeypatch.setattr(module, "nonlinear_mode", lost)

    status, output, error = two_modes(tmp_path, capsys)

    assert status == 1
    assert output.count(" points with ") == 1
    assert "it has no first point: no first point: try less" in output
    assert error.startswith(
        "microslip: 1 of 2 modes cannot be followed to the end, at "
    )
    assert error.endswith("; what was computed is kept\n")
    assert error.count("\n") == 1
    assert (tmp_path / "modes.csv").stat().st_size > 100
    assert (tmp_path / "modes.png").is_file()


def test_modes_without_any_point_leave_no_file(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def lost(*_: object) -> Iterator[NonlinearMode]:
        raise ContinuationError("no first point: try less")

    for module in (mode_beginning, modes):
        monkeypatch.setattr(module, "nonlinear_mode", lost)

    status, _, error = two_modes(tmp_path, capsys)

    assert (status, error) == (1, "microslip: no first point: try less\n")
    assert not list(tmp_path.iterdir())


def test_a_table_that_cannot_be_written_is_told_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "modes.csv").mkdir()

    status, output, error = two_modes(tmp_path, capsys)

    assert (status, output) == (2, "")
    assert error.startswith(f"microslip: {tmp_path / 'modes.csv'} is a folder and")
    assert error.count("\n") == 1


def fake_growth(
    fine: list[float], ends: dict[int | None, float]
) -> Callable[..., Iterator[NonlinearMode]]:
    """Return modes of given amplitudes that stop at one that harmonics decide."""

    def growth(*given: Any) -> Iterator[NonlinearMode]:
        harmonics, shape = given[-1].harmonics, given[-2].shape
        motion = np.array([0.0 * shape.real, shape.real, -shape.imag])
        for amplitude in fine:
            if amplitude > ends[harmonics]:
                raise ContinuationError("the curve does not go on")
            moved = np.array([amplitude + 0j])
            yield NonlinearMode(-1.0 + 9j, moved, motion, 0.0, 0.0, harmonics or 31, 64)

    return growth


@pytest.mark.parametrize(
    ("ends", "harmonics", "ending"),
    [
        ({None: 5.0}, [31] * 5, "complete"),
        ({None: 2.0, 7: 5.0}, [31] * 2 + [7] * 3, "complete"),
        ({None: 2.0, 7: 4.0, 3: 5.0}, [31] * 2 + [3] * 3, "complete"),
        ({None: 2.0, 7: 4.0, 3: 3.0, 1: 1.0}, [31] * 2 + [7] * 2, "does not go on"),
        ({None: 2.0, 7: 1.0, 3: 1.0, 1: 1.0}, [31] * 2, "does not go on"),
        ({None: 0.0, 7: 5.0}, [7] * 5, "complete"),
    ],
)
def test_a_mode_that_stops_goes_on_with_fewer_harmonics(
    monkeypatch: pytest.MonkeyPatch,
    ends: dict[int | None, float],
    harmonics: list[int],
    ending: str,
) -> None:
    fine = [1.0, 2.0, 3.0, 4.0, 5.0]
    for module in (mode_beginning, modes):
        monkeypatch.setattr(module, "nonlinear_mode", fake_growth(fine, ends))

    (mode,) = followed(rig_problem(), RANGE, ModeOptions(1.0, 5.0))

    (line,) = mode_lines([mode])
    assert line.coarse == ("" if harmonics[-1] == 31 else f"{harmonics[-1]} harmonics")
    assert modes_figure([line], "mode").axes
    assert [point.harmonics for point in mode.points] == harmonics
    assert [point.amplitude for point in mode.points] == fine[: len(harmonics)]
    assert ending in mode.ending
    told = "\n".join(mode_table(mode, "in small motions"))
    assert ("it ends at " in told) == (ending != "complete")
    assert ending in ending_of([mode])
    assert ("it does not go on with those" in told) == (len(set(harmonics) - {31}) > 0)


def test_the_work_for_a_mode_is_bounded() -> None:
    problem = microslip.scene("jenkins")
    spread = 115.0, 130.0  # its stuck frequency is 122.5 rad/s
    whole = ModeOptions(1e-4, 1.0, harmonics=7)

    (free,), (held,) = (
        followed(problem, spread, options)
        for options in (whole, replace(whole, effort=30.0))
    )

    assert free.ending == "complete"
    assert "30 evaluations" in held.ending
    assert "grant more" in held.ending
    assert 1 < len(held.points) < len(free.points)


def test_of_constant_damping_no_point_is_most_damped() -> None:
    problem = microslip.system(
        mass=[1.0], stiffness=[1e3], damping_ratio=0.01, drive={"x1": 1.0}
    )
    options = ModeOptions(1e-3, 2e-3, harmonics=1)

    (mode,) = followed(problem, (30.0, 33.0), options)

    told = "\n".join(mode_table(mode, "in small motions"))
    assert "most damped" not in told
    assert "points with 1 harmonic and 128 samples; " in told


def test_numbers_of_a_modes_table_have_one_notation_in_a_column() -> None:
    mode = grown("complete", [1e-5, 0.3])
    small = replace(mode.points[0], probes=np.array([1e-7 + 0j]))

    told = mode_table(replace(mode, points=(small, mode.points[1])), "at rest")

    rows = [line.split() for line in told[2:4]]
    assert [row[0] for row in rows] == ["1.000e-04", "2.000e+03"]
    assert [row[2] for row in rows] == ["1.000e-05", "3.000e-01"]


@pytest.mark.parametrize(("ending", "marks"), [("complete", 1), ("it stops", 0)])
def test_the_end_of_a_broken_mode_is_not_its_most_damped_point(
    ending: str, marks: int
) -> None:
    mode = grown(ending, [1.0, 2.0, 3.0])

    told = "\n".join(mode_table(mode, "in small motions"))

    assert told.count("most damped") == marks
    assert ("it ends at 3000 mm: it stops" in told) == (ending == "it stops")


def test_a_broken_mode_that_was_damped_more_says_where() -> None:
    told = mode_table(grown("it stops", [1.0, 3.0, 2.0]), "in small motions")

    assert [line.split()[0] for line in told if "most damped" in line] == ["2.000e+03"]


def test_of_several_modes_those_that_stop_short_are_named() -> None:
    whole, broken = grown("complete", [1.0]), grown("it stops", [1.0])
    pole = complex(0.0, math.tau * 140.0)
    other = replace(broken, linear=replace(broken.linear, pole=pole))

    assert ending_of([whole, whole]) == "complete"
    assert ending_of([broken]) == "it stops"
    assert ending_of([broken, whole, other]) == (
        "2 of 3 modes cannot be followed to the end, at 134.0000, 140.0000 Hz: "
        "their tables say why"
    )


def grown(ending: str, damping: list[float]) -> FollowedMode:
    """Return a mode with points of 1, 2, ... m and given damping."""
    points = [
        NonlinearMode(
            complex(-each, 100.0),
            np.array([place + 0j]),
            np.zeros((3, 1)),
            0.0,
            0.0,
            31,
            64,
        )
        for place, each in enumerate(damping, start=1)
    ]
    linear = LinearMode(complex(0.0, math.tau * 134.0), np.zeros(1, dtype=complex))
    return FollowedMode(linear, tuple(points), ending)
