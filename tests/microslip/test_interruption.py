"""What was computed is kept: interrupted, stuck, and stopped before the first point."""

import _thread
import contextlib
import ctypes
import itertools
import os
import pty
import re
import signal
import subprocess
import sys
import termios
import time
from collections import deque
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from threading import Timer
from typing import TypeAlias

import numpy as np
import pytest

from hbm.errors import ContinuationError
from hbm.solve import frequency_response
from microslip.files.result_file import load
from microslip.interruption import heeded, unmasked
from microslip.progress import shown
from microslip.studies.gathered import gathered
from microslip.studies.sweep import kept
from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.integrate import IntegrationError, integrate

Run: TypeAlias = Callable[..., tuple[int, str, str]]
CURVE = "microslip.studies.curve.frequency_response"
MARCH = "microslip.studies.sweep.integrate"


def curve_until(points: int, end: BaseException) -> Callable[..., object]:
    """Return a solver whose curve ends after some points."""

    def solved(*arguments: object) -> Iterator[PeriodicResponse]:
        yield from itertools.islice(frequency_response(*arguments), points)  # type: ignore[arg-type]
        raise end

    return solved


def march_until(blocks: int, end: BaseException) -> Callable[..., object]:
    """Return an integrator whose march ends after some blocks of a millisecond."""

    def solved(*arguments: object, **named: object) -> Iterator[TimeHistory]:
        march = integrate(*arguments, **named, block=1e-3)  # type: ignore[arg-type]
        yield from itertools.islice(march, blocks)
        raise end

    return solved


@pytest.mark.parametrize("points", [1, 3])
@pytest.mark.parametrize(
    ("end", "ending", "status"),
    [
        (KeyboardInterrupt(), "interrupted", 130),
        (
            ContinuationError("stuck at a fold: try less"),
            "stuck at a fold: try less",
            1,
        ),
    ],
    ids=["interrupted", "stuck"],
)
def test_points_before_the_end_of_a_curve_are_kept(
    points: int,
    end: BaseException,
    ending: str,
    status: int,
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(CURVE, curve_until(points, end))

    ended, output, error = run("frc", str(quick_scene))

    assert ended == status
    assert error == f"microslip: {ending}; what was computed is kept\n"
    assert f"{points} points in quick-frc.nc" in output
    curve = load(tmp_path / "quick-frc.nc").result
    assert isinstance(curve, ResponseCurve)
    assert curve.ending == ending
    assert len(curve.frequency) == points
    assert curve.frequency[0] / (2.0 * np.pi) == pytest.approx(130.0)
    assert (tmp_path / "quick-frc.png").is_file()


@pytest.mark.parametrize("blocks", [1, 3])
@pytest.mark.parametrize(
    ("end", "ending", "status"),
    [
        (KeyboardInterrupt(), "interrupted", 130),
        (IntegrationError("stuck at 3 ms: try less"), "stuck at 3 ms: try less", 1),
    ],
    ids=["interrupted", "stuck"],
)
def test_times_before_the_end_of_a_march_are_kept(
    blocks: int,
    end: BaseException,
    ending: str,
    status: int,
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(MARCH, march_until(blocks, end))

    ended, output, error = run("sweep", str(quick_scene))

    assert ended == status
    assert error == f"microslip: {ending}; what was computed is kept\n"
    history = load(tmp_path / "quick-sweep.nc").result
    assert isinstance(history, TimeHistory)
    assert history.ending == ending
    assert history.time[-1] == pytest.approx(1e-3 * blocks)
    assert f"{len(history.time)} times in quick-sweep.nc" in output
    assert (tmp_path / "quick-sweep.png").is_file()


@pytest.mark.parametrize(
    ("command", "name", "ended"),
    [("frc", CURVE, curve_until), ("sweep", MARCH, march_until)],
)
@pytest.mark.parametrize(
    ("end", "ending", "status"),
    [
        (
            KeyboardInterrupt(),
            "interrupted; files are written only where named above",
            130,
        ),
        (ContinuationError("stuck: try less"), "stuck: try less", 1),
        (IntegrationError("stuck: try less"), "stuck: try less", 1),
    ],
    ids=["interrupted", "stuck curve", "stuck march"],
)
def test_end_before_the_first_result_leaves_no_file(
    command: str,
    name: str,
    ended: Callable[..., Callable[..., object]],
    end: BaseException,
    ending: str,
    status: int,
    run: Run,
    quick_scene: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(name, ended(0, end))

    left, output, error = run(command, str(quick_scene))

    assert (left, output) == (status, "")
    assert error == f"microslip: {ending}\n"
    assert list(tmp_path.iterdir()) == [quick_scene]


@pytest.mark.parametrize(
    ("name", "solver"), [(CURVE, curve_until), (MARCH, march_until)]
)
def test_interrupted_verification_has_status_130_and_no_verdict(
    name: str,
    solver: Callable[..., Callable[..., object]],
    run: Run,
    quick_scene: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(name, solver(2, KeyboardInterrupt()))
    few = ("--frequencies", "1", "--periods", "2", "--slower", "1")
    range_of_curve = ("--set=sweep.lowest=130 Hz", "--set=sweep.highest=130.2 Hz")

    status, output, error = run("verify", str(quick_scene), *few, *range_of_curve)

    assert status == 130
    verdicts = [line for line in output.splitlines() if "agree: " in line]
    assert verdicts == []
    assert "microslip: interrupted" in error


def wait_for_progress(screen: int) -> None:
    """Wait until the bar on a terminal has begun to move."""
    shown = b""
    while not re.search(rb" [1-9]\d*%\|", shown):
        shown += os.read(screen, 1000)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("command", "long", "stop"),
    [
        ("frc", ("curve.harmonics=150", "friction.law=gkf"), signal.SIGINT),
        ("sweep", ("sweep.duration=1000", "model=A"), signal.SIGINT),
        ("sweep", ("sweep.duration=1000", "model=A"), signal.SIGTERM),
    ],
)
def test_interrupt_from_the_keyboard_or_a_batch_system_keeps_what_was_computed(
    command: str, long: tuple[str, ...], stop: signal.Signals, tmp_path: Path
) -> None:
    screen, terminal = pty.openpty()
    termios.tcsetwinsize(terminal, (24, 80))
    result = tmp_path / f"two-blades-{command}.nc"

    with subprocess.Popen(
        [sys.executable, "-m", "microslip", command, "two-blades"]
        + [f"--set={each}" for each in long],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=terminal,
        # what runs in the background of a shell has been told to ignore it
        preexec_fn=partial(signal.signal, signal.SIGINT, signal.SIG_DFL),
    ) as process:
        os.close(terminal)
        wait_for_progress(screen)
        process.send_signal(stop)
        try:
            output, _ = process.communicate(timeout=60)
        finally:
            process.kill()
    os.close(screen)

    assert process.returncode == 130
    assert result.name in output.decode()
    assert load(result).result.ending == "interrupted"
    assert result.with_suffix(".png").is_file()


@kernel
def lasting(steps: int) -> tuple[Array, Array]:
    """Return arrays after a while: numba runs a Python function to make each."""
    total = np.zeros(1)
    for step in range(steps):
        total[0] += np.sin(total[0] + step)
    return total, total


def forever() -> Iterator[int]:
    """Work in kernels, between which a signal hardly ever comes."""
    lasting(1)
    yield 0
    Timer(0.05, _thread.interrupt_main).start()
    while True:
        lasting(10_000_000)


def looped(items: Iterator[int]) -> None:
    with unmasked():
        deque(items, maxlen=0)


def gathered_from(items: Iterator[int]) -> tuple[list[int], str]:
    """Return what is gathered of responses, by their frequencies, and how it ends."""
    empty = np.zeros(0)
    rest = np.zeros((3, 1)), empty, empty, 0.0, 0.0, 0.0, "converged", 1
    found, ending = gathered(PeriodicResponse(each, *rest) for each in items)
    return [int(each.frequency) for each in found], ending


def kept_by(items: Iterator[int]) -> tuple[list[int], str]:
    """Return what is kept of a march, and how it ends."""
    blocks: list[int] = []
    ending = kept(items, blocks.append)
    return blocks, ending


@pytest.mark.parametrize(
    "taking",
    [
        looped,
        gathered_from,
        lambda items: deque(
            shown(items, total=1.0, done=float, unit="s", name="test"), maxlen=0
        ),
        kept_by,
    ],
    ids=["within", "gathered", "shown", "kept"],
)
def test_an_interruption_within_a_kernel_remains_one(
    taking: Callable[[Iterator[int]], object],
) -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    try:
        with contextlib.suppress(KeyboardInterrupt):
            assert taking(forever()) == ([0], "interrupted")
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_interruption_that_a_foreign_call_loses_comes_again() -> None:
    def interrupted() -> None:
        raise KeyboardInterrupt

    called = ctypes.CFUNCTYPE(None)(interrupted)

    def run() -> None:
        with heeded():
            called()
            for _ in range(1000):
                time.sleep(0.01)

    before = signal.signal(signal.SIGINT, signal.default_int_handler)

    try:
        with pytest.raises(KeyboardInterrupt):
            run()
    finally:
        signal.signal(signal.SIGINT, before)


def test_what_fails_for_a_lost_interruption_is_one() -> None:
    def interrupted() -> None:
        raise KeyboardInterrupt

    def run() -> None:
        with heeded():
            ctypes.CFUNCTYPE(None)(interrupted)()
            raise RuntimeError("no compiled object yet")

    with pytest.raises(KeyboardInterrupt):
        run()

    time.sleep(0.1)  # nothing comes later


def test_what_else_a_foreign_call_loses_is_reported(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    reported: list[sys.UnraisableHookArgs] = []
    monkeypatch.setattr(sys, "unraisablehook", reported.append)

    def failed() -> None:
        raise ValueError("a defect")

    with heeded():
        ctypes.CFUNCTYPE(None)(failed)()

    assert [str(each.exc_value) for each in reported] == ["a defect"]


def test_another_error_of_a_kernels_call_is_not_taken_for_an_interruption() -> None:
    with pytest.raises(SystemError, match="a defect"), unmasked():
        raise SystemError("a defect")
