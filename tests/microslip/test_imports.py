"""What a command does not need is never loaded: checked in new processes."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

from microslip.files.store import Stored, save
from microslip_mechanics.results.response_curve import ResponseCurve

SCREEN = {"matplotlib.pyplot", "tkinter"}
"""needs a display, or looks for one"""
PROBE = """
import json, sys
from microslip.cli import main
try:
    status = main(sys.argv[1:])
except SystemExit as left:
    status = left.code
print()
print(json.dumps([status, sorted(sys.modules)]))
"""


def loaded_by(*arguments: str, folder: Path) -> set[str]:
    """Return the modules that a command loads."""
    ended = subprocess.run(
        [sys.executable, "-c", PROBE, *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    status, modules = json.loads(ended.stdout.splitlines()[-1])
    assert status == 0, ended.stderr
    return set(modules)


@pytest.mark.parametrize(
    "arguments",
    [
        ("--help",),
        ("--version",),
        *[(command, "--help") for command in ("frc", "sweep", "verify", "report")],
        ("scenes",),
        ("scenes", "two-blades"),
    ],
    ids=" ".join,
)
def test_help_and_scenes_load_no_numbers(
    arguments: tuple[str, ...], tmp_path: Path
) -> None:
    modules = loaded_by(*arguments, folder=tmp_path)

    heavy = {"numpy", "scipy", "numba", "matplotlib", "pyfftw", "tqdm"}
    assert not heavy & modules
    assert not {"hbm", "timedomain"} & modules


def test_frc_loads_neither_the_time_domain_nor_searches(
    quick_scene: Path, tmp_path: Path
) -> None:
    modules = loaded_by("frc", str(quick_scene), folder=tmp_path)

    assert {"hbm", "pyfftw"} <= modules
    assert not {"timedomain", *SCREEN} & modules
    assert not {"hbm.curves.branches", "hbm.curves.drive_search"} & modules
    assert not {"hbm.forces.memory", "hbm.stability.recalled"} & modules
    assert (tmp_path / "quick-frc.nc").is_file()


def test_sweep_does_not_load_harmonic_balance(
    quick_scene: Path, tmp_path: Path
) -> None:
    modules = loaded_by("sweep", str(quick_scene), folder=tmp_path)

    assert "timedomain" in modules
    assert not {"hbm", "pyfftw", *SCREEN} & modules
    assert (tmp_path / "quick-sweep.nc").is_file()


def test_plot_loads_no_solver(small_curve: ResponseCurve, tmp_path: Path) -> None:
    save(tmp_path / "result.nc", Stored(small_curve, "", ""))

    modules = loaded_by("plot", "result.nc", folder=tmp_path)

    assert "matplotlib" in modules
    assert not {"hbm", "timedomain", "pyfftw"} & modules


SPARED = {
    "microslip.scenes.turning",
    "microslip_mechanics.structures.rotating_frame",
    "microslip_mechanics.loads.base_excitation",
    "microslip_mechanics.reduction.reduced_problem",
}
"""needed by scenes that turn, whose ground moves, or that are reduced"""
TURNED = ("rotation.speed=10", "rotation.axis=[0,0,1]", "rotation.centre=[0,-1,0]")
CARRIED = ("base.direction=[0,0,1]", "base.acceleration=1")


@pytest.mark.parametrize(
    ("scene", "overrides", "needed"),
    [
        ("two-blades", (), ()),
        ("friction-beam", (), ()),
        ("two-blades", TURNED, ("scenes.turning", "structures.rotating_frame")),
        ("friction-beam", CARRIED, ("loads.base_excitation",)),
        (
            "friction-beam",
            ("structure.reduction.highest=20000",),
            ("reduction.reduced_problem",),
        ),
    ],
)
def test_a_problem_loads_what_its_scene_has(
    scene: str, overrides: tuple[str, ...], needed: tuple[str, ...], tmp_path: Path
) -> None:
    modules = loaded_with(
        "from microslip.scenes.rigs import problem_of; "
        "from microslip.scenes.scene_file import load_scene; "
        f"problem_of(load_scene({scene!r}, {overrides!r}))",
        folder=tmp_path,
    )

    found = {name for name in SPARED if name in modules}
    assert found == {name for name in SPARED if name.endswith(needed)}


def test_tables_load_no_harmonic_balance(tmp_path: Path) -> None:
    modules = loaded_with("import microslip.studies.tables", folder=tmp_path)

    assert "timedomain" in modules
    assert not {"hbm", "pyfftw"} & modules


def loaded_with(code: str, folder: Path) -> set[str]:
    """Return the modules that some code loads."""
    ended = subprocess.run(
        [sys.executable, "-c", f"{code}; import sys; print(*sys.modules)"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    return set(ended.stdout.split())
