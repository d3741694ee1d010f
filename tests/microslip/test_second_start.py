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


@pytest.mark.slow
@pytest.mark.parametrize("command", ["frc", "sweep"])
def test_second_start_compiles_nothing(
    command: str, quick_scene: Path, tmp_path: Path
) -> None:
    cache = tmp_path / "cache"

    first = started(command, quick_scene, cache)
    second = started(command, quick_scene, cache)

    assert any(name.endswith(".nbc") for name in first)
    assert second == first


@pytest.mark.slow
def test_other_model_and_law_compile_nothing(quick_scene: Path, tmp_path: Path) -> None:
    cache, other = tmp_path / "cache", tmp_path / "other.toml"
    text = quick_scene.read_text().replace('"A"', '"full"', 1)
    other.write_text(text.replace('law = "coulomb"', 'law = "gkf"'))

    first = started("frc", quick_scene, cache)
    second = started("frc", other, cache)

    assert second == first
