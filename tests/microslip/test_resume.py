"""A sweep that was stopped can be read, drawn, and continued to the same end."""

import dataclasses
import errno
import itertools
import re
import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.files.record_file import RecordFile
from microslip.files.recording import Recording, last_state
from microslip.files.result_file import load
from microslip.files.store import StoreError
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import built_in_text, load_scene
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.integrate import integrate

Run: TypeAlias = Callable[..., tuple[int, str, str]]
MARCH = "microslip.studies.sweep.integrate"
LONG = ("--set", "sweep.end=60 ms", "--set", "sweep.duration=65 ms")


def stopped(blocks: int) -> Callable[..., object]:
    """Return an integrator that is interrupted after blocks of 7 ms."""

    def marched(*arguments: object, **named: object) -> Iterator[TimeHistory]:
        march = integrate(*arguments, **named, block=7e-3)  # type: ignore[arg-type]
        yield from itertools.islice(march, blocks)
        raise KeyboardInterrupt

    return marched


def check_equal(part: object, whole: object) -> None:
    """Check that two results are the same to 1e-12, work and checkpoint included."""
    assert type(part) is type(whole)
    for field in dataclasses.fields(whole):  # type: ignore[arg-type]
        ours, theirs = getattr(part, field.name), getattr(whole, field.name)
        if isinstance(theirs, Checkpoint):
            check_equal(ours, theirs)
        elif isinstance(theirs, np.ndarray):
            scale = np.abs(theirs).max()
            np.testing.assert_allclose(
                ours, theirs, rtol=0.0, atol=1e-12 * scale, err_msg=field.name
            )
        else:
            assert ours == theirs, field.name


@pytest.mark.usefixtures("no_picture")
@pytest.mark.parametrize("kind", [(), ("--envelope",)], ids=["rows", "envelope"])
@pytest.mark.parametrize("blocks", [pytest.param(1, marks=pytest.mark.long), 5])
def test_two_parts_are_the_whole(
    blocks: int,
    kind: tuple[str, ...],
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    words = ("sweep", str(quick_scene), *LONG, *kind)
    assert run(*words, "-o", "whole")[0] == 0

    with monkeypatch.context() as stop:
        stop.setattr(MARCH, stopped(blocks))
        assert run(*words, "-o", "parts")[0] == 130
    part = load(tmp_path / "parts.nc").result
    status, output, _ = run(*words, "--resume", "parts.nc")

    assert status == 0
    assert "parts.nc" in output
    whole, both = (load(tmp_path / f"{name}.nc").result for name in ("whole", "parts"))
    assert isinstance(part, Envelope if kind else TimeHistory)
    assert isinstance(both, Envelope if kind else TimeHistory)
    assert part.ending == "interrupted"
    assert both.ending == "complete"
    assert 0 < len(part.time) < len(both.time)
    check_equal(both, whole)


def whole_and_part(
    run: Run, scene: Path, monkeypatch: pytest.MonkeyPatch
) -> tuple[str, ...]:
    """March a sweep to its end, and a part of it into a file of its own."""
    words = ("sweep", str(scene), *LONG)
    run(*words, "-o", "whole")
    with monkeypatch.context() as stop:
        stop.setattr(MARCH, stopped(3))
        run(*words, "-o", "parts")
    return words


@pytest.mark.usefixtures("blank_picture")
@pytest.mark.parametrize(
    "torn", [0, *(pytest.param(torn, marks=pytest.mark.long) for torn in (3, 997))]
)
def test_what_a_kill_left_half_written_is_marched_again(
    torn: int,
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    words = whole_and_part(run, quick_scene, monkeypatch)
    path = tmp_path / "parts.nc"
    before = load(path).result
    path.write_bytes(path.read_bytes() + b"\x7f" * torn)

    assert isinstance(before, TimeHistory)
    check_equal(load(path).result, before)
    assert run("plot", "parts.nc")[0] == 0
    assert run(*words, "--resume", "parts.nc")[0] == 0
    check_equal(load(path).result, load(tmp_path / "whole.nc").result)


@pytest.mark.usefixtures("no_picture")
def test_a_kill_between_the_state_and_the_number_of_its_rows_loses_no_row(
    run: Run, quick_scene: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    words = whole_and_part(run, quick_scene, monkeypatch)
    path = tmp_path / "parts.nc"
    content = bytearray(path.read_bytes())
    # a netCDF file begins with CDF, its version, and the number of its records
    (records,) = struct.unpack_from(">i", content, 4)
    struct.pack_into(">i", content, 4, records - 10)
    path.write_bytes(content)

    before = load(path).result
    assert isinstance(before, TimeHistory)
    assert before.time.size == records - 10
    assert run(*words, "--resume", "parts.nc")[0] == 0
    check_equal(load(path).result, load(tmp_path / "whole.nc").result)


@pytest.mark.usefixtures("no_picture")
def test_last_state_is_that_of_the_last_row_and_of_the_envelope(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    dense = ("--set", "march.store_every=1")
    run("sweep", str(quick_scene), *dense, "-o", "rows")
    run("sweep", str(quick_scene), *dense, "--envelope", "-o", "cycles")

    scene = load_scene(str(quick_scene), [dense[1]])
    states = [
        last_state(tmp_path / f"{name}.nc", scene.text) for name in ("rows", "cycles")
    ]

    history = load(tmp_path / "rows.nc").result
    assert isinstance(history, TimeHistory)
    seen = problem_of(scene).probes.rows
    for state, frequency in states:
        assert frequency == history.frequency[-1]
        for mine, its in (
            (state.displacement, history.displacement[-1]),
            (state.velocity, history.velocity[-1]),
        ):
            scale = np.abs(its).max()
            np.testing.assert_allclose(seen @ mine, its, rtol=0.0, atol=1e-9 * scale)
    np.testing.assert_array_equal(states[0][0].memory, states[1][0].memory)


@pytest.mark.usefixtures("no_picture")
def test_what_cannot_go_on_is_told_in_one_line(
    run: Run, quick_scene: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = str(quick_scene)
    run("sweep", scene, "-o", "done")
    with monkeypatch.context() as stop:
        stop.setattr(MARCH, stopped(1))
        run("sweep", scene, *LONG, "-o", "part")
    run("frc", scene, "-o", "curve")
    (tmp_path / "text.nc").write_text("no netCDF")
    for words, status, hint in (
        (
            ["--resume", "done.nc"],
            2,
            "is complete: there is nothing to resume, microslip plot draws it",
        ),
        (["--resume", "part.nc"], 2, "another scene"),
        ([*LONG, "--resume", "part.nc", "--envelope"], 2, "rows in time"),
        ([*LONG, "--resume", "part.nc", "-o", "new"], 2, "leave -o out"),
        (["--resume", "nowhere.nc"], 2, "there is no result file nowhere.nc"),
        (["--resume", "curve.nc"], 2, "holds a frequency response curve"),
        (["--resume", "text.nc"], 2, "is not a result file"),
    ):
        ended, _, error = run("sweep", scene, *words)
        assert (ended, error.count("\n")) == (status, 1), error
        assert hint in error
    part = load(tmp_path / "part.nc").result
    assert not isinstance(part, str)
    assert part.ending == "interrupted"


def with_matrices(folder: Path, name: str, stiffness: float) -> Path:
    """Write an oscillator whose matrices stand in a file beside it."""
    np.savez(folder / "blade.npz", M=[[1.0]], K=[[stiffness]])
    text = built_in_text("duffing").replace("mass = [1]", 'mass = "blade.npz"')
    path = folder / name
    text = re.sub(r"\nstiffness = \[[^\n]*", '\nstiffness = "blade.npz"', text, count=1)
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.usefixtures("no_picture")
def test_a_march_goes_on_with_the_matrices_that_it_began_with(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = with_matrices(tmp_path, "own.toml", 1e3)
    words = ("sweep", str(scene), *LONG)
    with monkeypatch.context() as stop:
        stop.setattr(MARCH, stopped(3))
        run(*words, "-o", "part")

    with_matrices(tmp_path, "own.toml", 1.3e3)
    status, _, error = run(*words, "--resume", "part.nc")
    assert status == 2
    assert error.startswith("microslip: part.nc was marched with other content of the")

    with_matrices(tmp_path, "own.toml", 1e3)
    assert run(*words, "--resume", "part.nc")[0] == 0


def test_work_of_a_block_that_a_full_disk_refused_is_not_counted(
    small_history: TimeHistory, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> int:
        raise OSError(errno.ENOSPC, "no space")

    history = dataclasses.replace(small_history, iterations=7, divided=3)
    path = tmp_path / "march.nc"
    with Recording(path, "", "first") as first:
        first.keep(history)
        with monkeypatch.context() as disk:
            disk.setattr(RecordFile, "append", full)
            stays = f"no space: its {history.time.size} rows so far stay"
            with pytest.raises(StoreError, match=stays):
                first.keep(history)

    kept = load(path).result
    assert isinstance(kept, TimeHistory)
    assert (kept.iterations, kept.divided) == (7, 3)


def test_a_file_that_another_command_writes_is_left_to_it(
    small_history: TimeHistory, tmp_path: Path
) -> None:
    path = tmp_path / "march.nc"
    with Recording(path, "", "first") as first:
        first.keep(small_history)
        with pytest.raises(StoreError, match="another command is writing it"):
            Recording(path, "", "second").keep(small_history)
        first.end(small_history.ending)

    check_equal(load(path).result, small_history)
    with Recording(path, "", "third") as third:
        third.keep(small_history)


@pytest.mark.usefixtures("no_picture")
def test_state_of_a_curve_is_refused(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    run("frc", str(quick_scene), "-o", "curve")

    with pytest.raises(StoreError, match="give what sweep or dwell wrote"):
        last_state(tmp_path / "curve.nc", "")
