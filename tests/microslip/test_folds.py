"""Folds of a scene's curve against a parameter, and the command that draws them."""

import csv
import itertools
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeAlias

import pytest

from hbm.curves.fold_curve import FoldPoint
from hbm.curves.parameter_curves import fold_curve
from microslip.studies.folds import followed_folds
from microslip.studies.parameter import parameter

Run: TypeAlias = Callable[..., tuple[int, str, str]]
SHORT = (
    "model=A",
    "friction.law=gkf",
    "curve.lowest=135.5 Hz",
    "curve.highest=137.2 Hz",
    "curve.harmonics=7",
    "curve.samples=512",
)
WORDS = [word for each in SHORT for word in ("--set", each)]


def cut(points: int, end: BaseException) -> Callable[..., Iterator[FoldPoint]]:
    """Return what follows a fold for some points, then ends."""

    def followed(*arguments: object) -> Iterator[FoldPoint]:
        yield from itertools.islice(fold_curve(*arguments), points)  # type: ignore[arg-type]
        raise end

    return followed


@pytest.mark.long
@pytest.mark.slow
def test_two_folds_that_meet_are_followed_once() -> None:
    fine = (*SHORT[:-2], "curve.harmonics=31", "curve.samples=1024")
    changed = parameter("two-blades", fine, "excitation.force", "1.35", "1")

    (fold,) = followed_folds(changed)

    curve = fold.curve
    assert curve.ending == "complete"
    assert curve.parameter[0] == curve.parameter[-1] == 1.35
    assert [event for event in curve.event if event] == ["cusp"]
    smallest = int(curve.parameter.argmin())
    assert curve.event[smallest] == "cusp"
    # `track` finds folds at 1.33 N and none at 1.25 N, with harmonics by tolerance
    assert 1.25 < curve.parameter[smallest] < 1.33
    assert fold.points[smallest].parameter_error < 0.02


@pytest.mark.long
@pytest.mark.slow
def test_folds_that_do_not_meet_are_followed_one_by_one() -> None:
    changed = parameter("two-blades", SHORT, "excitation.force", "1.8", "1.75 N")

    upper, lower = followed_folds(changed)

    for fold in (upper, lower):
        assert fold.curve.parameter[-1] == 1.75
    assert upper.curve.frequency.min() > lower.curve.frequency.max()


@pytest.mark.slow
def test_the_command_writes_a_table_and_a_picture(run: Run, tmp_path: Path) -> None:
    words = ("folds", "duffing", "drive.x", "0.1", "0.098")

    status, output, _ = run(*words, "-o", "jump")

    assert status == 0
    assert "fold 2, 7 harmonics" in output
    assert (tmp_path / "jump.png").stat().st_size > 10_000
    with (tmp_path / "jump.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert {row["fold"] for row in rows} == {"1", "2"}
    assert float(rows[0]["drive.x"]) == 0.1
    assert float(rows[-1]["drive.x"]) == 0.098
    assert all(5.3 < float(row["frequency_hz"]) < 5.6 for row in rows)


@pytest.mark.slow
def test_an_interrupted_fold_is_kept(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        "microslip.studies.folds.fold_curve", cut(2, KeyboardInterrupt())
    )

    status, output, error = run(
        "folds", "two-blades", "excitation.force", "1.8", "1.7", *WORDS, "-o", "jump"
    )

    assert status == 130
    assert error == "microslip: interrupted; what was computed is kept\n"
    assert "fold 2" not in output
    assert len((tmp_path / "jump.csv").read_text(encoding="utf-8").splitlines()) == 3


def test_a_curve_without_folds_says_so_in_a_line(run: Run, tmp_path: Path) -> None:
    few = ("--set", "model=A", "--set", "curve.harmonics=1")
    low = ("--set", "curve.lowest=130", "--set", "curve.highest=130.2")
    words = ("folds", "two-blades", "excitation.force", "1", "2", *few, *low)

    status, output, error = run(*words)

    # as `jumps` does: nothing went wrong
    assert status == 0
    assert output.startswith(
        "the curve at excitation.force = 1 has no folds between 130 and"
    )
    assert "track" in output
    assert output.count("\n") == 1
    assert "microslip: " not in error
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("key", "first", "last", "reason"),
    [
        ("excitation.farce", "1", "2", "force"),
        ("excitation.force", "1", "1 N", "two different values"),
        ("model", "A", "B", "cannot be followed"),
        ("excitation.force", "1", "2 kg", "unit"),
    ],
)
def test_what_cannot_change_is_refused(
    run: Run, key: str, first: str, last: str, reason: str
) -> None:
    status, _, error = run("folds", "two-blades", key, first, last)

    assert status == 2
    assert reason in error
    assert error.count("\n") == 1


def test_a_fold_that_goes_away_ends_there_with_known_errors(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("microslip.studies.folds.FAR", 1.0)
    wide = ("curve.highest=38 Hz",)
    less = parameter("duffing", wide, "structure.damping_ratio", "1.8e-4", "0")

    upper, _ = followed_folds(less)

    curve = upper.curve
    assert "goes away" in curve.ending
    assert 38.0 < curve.frequency[-1] / math.tau < 39.0
    assert all(point.frequency_error < 1e-5 for point in upper.points)
    # the peak at the fold is on the backbone, where c ω x = F but for other harmonics
    damping = 2.0 * curve.parameter[-1] * math.sqrt(1000.0)
    speed = curve.frequency[-1] * curve.amplitude[-1].max()
    assert damping * speed == pytest.approx(0.1, rel=0.02)
