"""The machine code of the kernels is kept: a second start compiles nothing."""

import os
import subprocess
import sys
from pathlib import Path

import pytest


def started(command: str, scene: Path, cache: Path) -> dict[str, tuple[int, int]]:
    """Run a command; return size and time of each file of the cache."""
    subprocess.run(
        [sys.executable, "-m", "microslip", command, str(scene)],
        cwd=scene.parent,
        env={**os.environ, "XDG_CACHE_HOME": str(cache)},
        capture_output=True,
        check=True,
    )
    return {
        str(path.relative_to(cache)): (path.stat().st_size, path.stat().st_mtime_ns)
        for path in (cache / "microslip").rglob("*")
        if path.is_file()
    }


@pytest.mark.slow(seconds=90)
def test_second_start_compiles_nothing_whatever_the_model_and_law(
    quick_scene: Path, tmp_path: Path
) -> None:
    cache, other = tmp_path / "cache", tmp_path / "other.toml"
    text = quick_scene.read_text().replace('"A"', '"full"', 1)
    other.write_text(text.replace('law = "coulomb"', 'law = "gkf"'))
    started("frc", quick_scene, cache)

    first = started("sweep", quick_scene, cache)
    again = [
        started(command, scene, cache)
        for command in ("frc", "sweep")
        for scene in (quick_scene, other)
    ]

    assert any(name.endswith(".nbc") for name in first)
    assert again == [first] * 4
