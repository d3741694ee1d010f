"""Commands that trace one curve after the other stop at the one that is interrupted."""

import csv
import itertools
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TypeAlias

import pytest

from hbm.errors import ContinuationError
from hbm.solve import frequency_response
from microslip.studies.grid import Case
from microslip.studies.worker import Ended, Task
from microslip_mechanics.results.response import PeriodicResponse

Run: TypeAlias = Callable[..., tuple[int, str, str]]
KEPT = "microslip: interrupted; what was computed is kept\n"


class Solver:
    """A solver whose first curve ends after two points, and that counts curves."""

    def __init__(self, end: BaseException) -> None:
        self.curves = 0
        self._end = end

    def __call__(self, *arguments: object) -> Iterator[PeriodicResponse]:
        """Yield the points of a curve."""
        self.curves += 1
        whole = frequency_response(*arguments)  # type: ignore[arg-type]
        if self.curves > 1:
            yield from whole
            return
        yield from itertools.islice(whole, 2)
        raise self._end


def solver(monkeypatch: pytest.MonkeyPatch, end: BaseException) -> Solver:
    """Return the solver that curves have from here on."""
    made = Solver(end)
    monkeypatch.setattr("microslip.studies.curve.frequency_response", made)
    return made


@pytest.mark.usefixtures("no_picture")
def test_track_keeps_the_curve_and_begins_no_other(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    curves = solver(monkeypatch, KeyboardInterrupt())

    status, output, error = run(
        "track", str(quick_scene), "excitation.force", "0.5", "1"
    )

    assert (status, error, curves.curves) == (130, KEPT, 1)
    assert "the curve is not whole: interrupted" in output
    assert "largest" not in output
    (row,) = rows_of(tmp_path / "quick-track.csv")
    assert (row["excitation.force"], row["event"]) == ("0.5", "")
    assert (row["amplitude_m"], row["ending"]) == ("nan", "interrupted")


def rows_of(path: Path) -> list[dict[str, str]]:
    """Return the rows of a table."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


@pytest.mark.usefixtures("no_picture")
def test_track_goes_on_behind_a_curve_that_is_stuck_and_says_so(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    curves = solver(monkeypatch, ContinuationError("stuck: try less"))

    status, output, error = run(
        "track", str(quick_scene), "excitation.force", "0.5", "1"
    )

    assert (status, curves.curves) == (1, 2)
    assert "the curve is not whole: stuck: try less" in output
    told = "microslip: 1 of 2 curves are not whole; what was computed is kept\n"
    assert error == told
    endings = {
        row["excitation.force"]: row["ending"]
        for row in rows_of(tmp_path / "quick-track.csv")
    }
    assert endings == {"0.5": "stuck: try less", "1": "complete"}


def test_grid_keeps_the_attempts_that_have_ended(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    def stopped(
        task: Task, cases: Sequence[Case], **_: object
    ) -> Iterator[Ended[Case]]:
        (attempt,) = task(cases[0], 60.0)
        yield Ended(cases[0], attempt, "", 1.0)
        raise KeyboardInterrupt

    monkeypatch.setattr("microslip.studies.grid.bounded", stopped)

    status, output, error = run(
        "grid", str(quick_scene), "--quick", "--csv", "grid.csv"
    )

    assert (status, error) == (130, KEPT)
    assert output.count("complete") == 1
    with (tmp_path / "grid.csv").open(encoding="utf-8", newline="") as file:
        (row,) = csv.DictReader(file)
    assert (row["law"], row["ending"]) == ("coulomb", "complete")


@pytest.mark.long
def test_a_comparison_does_not_trace_the_other_curve(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[bool] = []

    def interrupted(*arguments: object) -> Iterator[PeriodicResponse]:
        options = arguments[2]
        begun.append(options.pruned)  # type: ignore[attr-defined]
        yield from itertools.islice(frequency_response(*arguments), 2)  # type: ignore[arg-type]
        if options.samples != 32:  # type: ignore[attr-defined]
            raise KeyboardInterrupt

    monkeypatch.setattr(
        "microslip.studies.explain.unpruned.frequency_response", interrupted
    )

    status, _, error = run("explain", str(quick_scene), "--time")

    assert (status, error) == (130, "microslip: interrupted; no file is written\n")
    assert all(begun)


def test_precision_does_not_compare_on_a_part_of_the_curve(
    run: Run, quick_scene: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    solver(monkeypatch, KeyboardInterrupt())

    status, output, error = run("precision", str(quick_scene), "--quick")

    assert (status, output) == (130, "")
    assert error == "microslip: interrupted; files are written only where named above\n"
    assert list(tmp_path.iterdir()) == [quick_scene]
