"""What is no result, no element, no drive, and output that has no place."""

import os
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

import pytest

import microslip

START = "import sys; from microslip.cli import main"
Run: TypeAlias = Callable[..., tuple[int, str, str]]


@pytest.mark.parametrize("name", ["save", "figure"])
def test_a_problem_is_no_result(name: str, tmp_path: Path) -> None:
    problem = microslip.scene("duffing")

    with pytest.raises(microslip.MicroslipError, match=rf"^microslip\.{name}: .*give "):
        getattr(microslip, name)(problem, str(tmp_path / "result.nc"))


@pytest.mark.parametrize(
    ("given", "text"),
    [
        ({"drive": 0.5}, r"^drive = 0\.5: give amplitudes"),
        ({"elements": [microslip.CubicSpring(cubic=1.0)]}, "^element 1 is CubicSpring"),
    ],
)
def test_what_is_no_drive_or_element_is_told(given: dict[str, Any], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        microslip.system(mass=[1.0], stiffness=[1.0], **given)


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no device that is full")
def test_output_to_a_full_disk_ends_with_one_line() -> None:
    with Path("/dev/full").open("w", encoding="utf-8") as full:
        done = subprocess.run(
            [sys.executable, "-c", f"{START}; sys.exit(main(['scenes']))"],
            stdout=full,
            stderr=subprocess.PIPE,
            text=True,
            check=False,
        )

    assert done.returncode == 1
    assert done.stderr == (
        f"microslip: the output cannot be written: {os.strerror(28)}\n"
    )


@pytest.mark.skipif(os.name == "nt", reason="no shell that closes outputs")
@pytest.mark.parametrize(
    ("closed", "told"), [(">&-", b""), ("2>&-", b"duffing"), (">&- 2>&- <&-", b"")]
)
def test_outputs_that_are_closed_end_nothing(closed: str, told: bytes) -> None:
    words = f"{shlex.quote(sys.executable)} -m microslip scenes {closed}"
    done = subprocess.run(["sh", "-c", words], capture_output=True, check=False)

    assert (done.returncode, done.stderr) == (0, b"")
    assert told in done.stdout


def test_a_folder_that_is_none_is_refused(run: Run) -> None:
    status, _, error = run("frc", "duffing", "-o", "nowhere/")

    assert status == 2
    assert "there is no folder nowhere/: make it first" in error


def test_a_decay_of_one_period_is_too_short(run: Run) -> None:
    status, output, error = run("decay", "duffing", "--frequency", "5", "--periods=1")

    assert status == 1
    assert "decay in duffing-decay.nc" in output
    assert "does not swing to and fro often enough" in error
    assert not Path("duffing-decay.png").exists()
