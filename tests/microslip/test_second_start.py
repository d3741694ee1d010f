"""The machine code of the kernels is kept: a second start compiles nothing."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

USED = re.compile(r"\[cache\] data (loaded from|saved to) '.*[/\\](.+)'")
"""what numba tells of a kernel and its signature"""


def kernels(command: str, scene: Path) -> tuple[set[str], set[str]]:
    """Run a command; return the kernels it found on disk, and those it compiled."""
    done = subprocess.run(
        [sys.executable, "-m", "microslip", command, str(scene)],
        cwd=scene.parent,
        env={**os.environ, "NUMBA_DEBUG_CACHE": "1"},
        capture_output=True,
        check=True,
        text=True,
    )
    told = USED.findall(done.stdout)
    loaded = {name for what, name in told if what == "loaded from"}
    return loaded, {name for what, name in told if what == "saved to"}


@pytest.mark.slow(seconds=90)
@pytest.mark.long
def test_second_start_compiles_nothing_whatever_the_model_and_law(
    quick_scene: Path, tmp_path: Path
) -> None:
    other = tmp_path / "other.toml"
    text = quick_scene.read_text().replace('"A"', '"full"', 1)
    other.write_text(text.replace('law = "coulomb"', 'law = "gkf"'))

    first = [kernels(command, quick_scene) for command in ("frc", "sweep")]
    again = [kernels(command, other) for command in ("frc", "sweep")]

    # other tests may have kept machine code that the first runs did not ask for
    known = set().union(*(loaded | compiled for loaded, compiled in first))
    assert known
    for loaded, compiled in again:
        assert (loaded - known, compiled) == (set(), set())
