"""Which kernels a command compiles: none that are kept, none that a scene lacks."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

USED = re.compile(r"\[cache\] data (loaded from|saved to) '.*[/\\](.+)'")
"""what numba tells of a kernel and its signature"""


def kernels(command: str, scene: str, folder: Path) -> tuple[set[str], set[str]]:
    """Return the kernels that a command finds on disk, and those that it compiles."""
    done = subprocess.run(
        [sys.executable, "-m", "microslip", command, scene],
        cwd=folder,
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

    first = [
        kernels(command, str(quick_scene), tmp_path) for command in ("frc", "sweep")
    ]
    again = [kernels(command, str(other), tmp_path) for command in ("frc", "sweep")]

    # other tests may have kept machine code that the first runs did not ask for
    known = set().union(*(loaded | compiled for loaded, compiled in first))
    assert known
    for loaded, compiled in again:
        assert (loaded - known, compiled) == (set(), set())


def test_a_smooth_scene_compiles_nothing_that_resolves_transitions(
    tmp_path: Path,
) -> None:
    loaded, compiled = kernels("frc", "duffing", tmp_path)

    used = {name.split("-")[0] for name in loaded | compiled}
    assert "sampling.sample_smooth" in used
    resolving = {"sampling.sample", "contact_path.events", "contact_cycle._unseen"}
    assert not used & resolving
    assert not [name for name in used if name.startswith(("refine", "transitions"))]
