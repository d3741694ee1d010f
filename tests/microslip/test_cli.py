"""The command line: help, files, texts, exit statuses."""

import re
import shlex
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.files.result_file import load
from microslip.files.schema import Result
from microslip.files.store import Stored, save
from microslip.scenes.scene_file import built_in_text
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory

Run: TypeAlias = Callable[..., tuple[int, str, str]]
COMMANDS = (
    "frc",
    "sweep",
    "dwell",
    "decay",
    "verify",
    "track",
    "follow",
    "folds",
    "jumps",
    "poles",
    "modes",
    "precision",
    "grid",
    "stress",
    "tables",
    "report",
    "scenes",
    "explain",
    "plot",
)


def curve_of(path: Path) -> ResponseCurve:
    """Return the curve in a file."""
    result = load(path).result
    assert isinstance(result, ResponseCurve)
    return result


def history_of(path: Path) -> TimeHistory:
    """Return the history in a file."""
    result = load(path).result
    assert isinstance(result, TimeHistory)
    return result


def test_help_lists_every_command_and_where_to_begin(run: Run) -> None:
    status, output, error = run("--help")

    assert (status, error) == (0, "")
    assert "start with: microslip frc two-blades" in output
    assert "exit status: 0 done, 1 failed, not whole (what was" in output
    listed = re.findall(r"^    (\w+)(?:  |$)", output, re.MULTILINE)
    assert sorted(listed) == sorted(COMMANDS)


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_every_command_ends_with_an_example(command: str, run: Run) -> None:
    status, output, error = run(command, "--help")

    assert (status, error) == (0, "")
    (example,) = re.findall(r"example: (microslip .*)", output)
    assert shlex.split(example)[:2] == ["microslip", command]
    assert "%%" not in output


def test_version_is_that_of_the_package(run: Run) -> None:
    status, output, _ = run("--version")

    assert status == 0
    assert re.fullmatch(r"microslip \d+\.\d+\.\d+\n", output)


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        ((), "COMMAND"),
        (("frf", "two-blades"), "frf"),
        (("frc",), "scene"),
        (("frc", "two-blades", "--harmonics", "8"), "--harmonics"),
        (("frc", "two-blades", "--set"), "--set"),
        (("verify", "two-blades", "--frequencies", "0"), "give a whole number from 1"),
        (("verify", "two-blades", "--periods", "1.5"), "--periods"),
        (("verify", "two-blades", "--tolerance", "small"), "--tolerance"),
        (("sweep", "duffing", "--tolerance", "1e-30"), "between 1e-14 and 1"),
        (("sweep", "duffing", "--tolerance", "small"), "small: give one between"),
        (("verify", "two-blades", "--slower", "much"), "--slower"),
        (("sweep", "two-blades", "--step", "1"), "sweep: no such argument: --step"),
        (("frc", "two-blades", "more"), "see microslip frc --help"),
    ],
)
def test_wrong_usage_has_status_2_and_a_reason(
    arguments: tuple[str, ...], word: str, run: Run
) -> None:
    status, output, error = run(*arguments)

    assert (status, output) == (2, "")
    (line,) = error.splitlines()
    assert line.startswith("microslip: ")
    assert word in line


def test_built_in_scenes_are_listed_with_their_variants(run: Run) -> None:
    status, output, _ = run("scenes")

    assert status == 0
    for words in ("two-blades", "model=full | B | A", "coulomb | gkf | none"):
        assert words in output


def test_printed_scene_is_a_scene_that_can_be_run(run: Run, tmp_path: Path) -> None:
    status, output, _ = run("scenes", "two-blades")
    (tmp_path / "mine.toml").write_text(output, encoding="utf-8")

    assert status == 0
    assert output == built_in_text("two-blades")
    short = ("--set", "model=A", "--set", "curve.highest=125.1 Hz")
    assert run("frc", "mine.toml", *short)[0] == 0


def test_curve_is_written_drawn_and_told(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    status, output, error = run("frc", str(quick_scene))

    assert (status, error) == (0, "")
    curve = curve_of(tmp_path / "quick-frc.nc")
    assert curve.ending == "complete"
    assert curve.frequency[[0, -1]] / (2.0 * np.pi) == pytest.approx([130.0, 130.2])
    assert (tmp_path / "quick-frc.png").read_bytes().startswith(b"\x89PNG")
    (largest,) = (line for line in output.splitlines() if line.endswith("largest"))
    peak = curve.amplitude[:, 0].argmax()
    assert float(largest.split()[1]) == pytest.approx(
        1e3 * curve.amplitude[peak, 0], abs=1e-5
    )
    assert f"{len(curve.frequency)} points in quick-frc.nc" in output
    assert re.search(
        r"estimated error of amplitude: at most \S+ % at a point, \S+ % in the "
        r"median; 1 harmonic, 16 samples$",
        output,
        re.MULTILINE,
    )
    assert "\nestimated error of what friction takes out: at most " in output
    assert "normal force at rest [N]: B1 2.924, A1 2.747" in output


def test_sweep_is_written_drawn_and_told(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    status, output, error = run("sweep", str(quick_scene))

    assert (status, error) == (0, "")
    history = history_of(tmp_path / "quick-sweep.nc")
    assert history.ending == "complete"
    assert history.time[-1] == pytest.approx(0.01)
    assert (tmp_path / "quick-sweep.png").read_bytes().startswith(b"\x89PNG")
    for name in history.energies:
        (line,) = re.findall(rf"^  {name.replace('_', ' ')} +(\S+)$", output, re.M)
        assert float(line) == pytest.approx(history.of(name)[-1], rel=1e-4)
    assert "closing error" in output
    assert f"{len(history.time)} times in quick-sweep.nc" in output
    assert "normal force [N], least and most\n  B1 " in output


@pytest.mark.usefixtures("no_picture")
def test_what_pulls_and_pushes_has_no_normal_force(run: Run) -> None:
    short = [f"--set=sweep.{key}=0.5" for key in ("end", "duration")]

    status, output, _ = run("sweep", "duffing", *short)

    assert status == 0
    assert "\nforce [N], least and most\n  cubic " in output


@pytest.mark.usefixtures("no_picture")
def test_what_has_no_normal_force_is_not_told_one(run: Run) -> None:
    short = [f"--set=sweep.{key}=0.01" for key in ("end", "duration")]

    status, output, _ = run("sweep", "jenkins", *short)

    assert status == 0
    assert "largest displacement [mm]" in output
    assert "normal force" not in output


@pytest.mark.usefixtures("no_picture")
@pytest.mark.parametrize("command", ["frc", "sweep"])
def test_file_tells_the_command_that_made_it(
    command: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    arguments = (command, str(quick_scene), "--set", "curve.highest=130.1 Hz")

    assert run(*arguments)[0] == 0

    stored = load(tmp_path / f"quick-{command}.nc")
    assert shlex.split(stored.command) == ["microslip", *arguments]


@pytest.mark.usefixtures("no_picture")
def test_file_holds_the_scene_with_its_overrides(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    assert run("frc", str(quick_scene), "--set", "contact.sigma=3e-7")[0] == 0

    stored = load(tmp_path / "quick-frc.nc")
    assert stored.scene == f"{quick_scene.read_text()}\n# --set contact.sigma=3e-7"


@pytest.mark.usefixtures("blank_picture")
@pytest.mark.parametrize(
    ("chosen", "name"),
    [
        ("curve.nc", "curve"),
        ("curve.png", "curve"),
        ("results/sigma-3e-7.v1", "results/sigma-3e-7.v1"),
    ],
)
def test_results_go_where_they_are_wanted(
    chosen: str, name: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    (tmp_path / "results").mkdir()

    status, output, _ = run("frc", str(quick_scene), "-o", chosen)

    assert status == 0
    assert f"points in {name}.nc, picture in {name}.png" in output
    assert (tmp_path / f"{name}.nc").is_file()
    assert (tmp_path / f"{name}.png").is_file()


@pytest.mark.usefixtures("blank_picture")
@pytest.mark.parametrize("chosen", ["", ".", "results", "results/"])
def test_results_in_a_folder_have_the_name_of_the_scene(
    chosen: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    (tmp_path / "results").mkdir()

    status, output, _ = run("frc", str(quick_scene), "-o", chosen)

    assert status == 0
    path = Path(chosen) / "quick-frc.nc"
    assert f"points in {path}, picture in {path.with_suffix('.png')}" in output
    assert (tmp_path / path).is_file()
    assert (tmp_path / path.with_suffix(".png")).is_file()


@pytest.mark.parametrize("command", ["frc", "sweep", "verify"])
@pytest.mark.parametrize("chosen", ["nowhere/curve", "quick.toml/curve"])
def test_results_without_a_place_are_refused_before_the_work(
    command: str, chosen: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    status, output, error = run(command, str(quick_scene), "-o", chosen)

    assert status == 2
    assert output == ""
    assert error.startswith("microslip: ")
    assert len(error.splitlines()) == 1
    assert list(tmp_path.iterdir()) == [quick_scene]


@pytest.mark.parametrize("name", ["cost$_$", "Schaufel für Übung", "two.blades"])
def test_any_name_of_a_scene_will_do(
    name: str, run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    quick_scene.rename(tmp_path / f"{name}.toml")

    status, _, error = run("frc", f"{name}.toml")

    assert (status, error) == (0, "")
    assert (tmp_path / f"{name}-frc.nc").is_file()
    assert (tmp_path / f"{name}-frc.png").is_file()


def test_scene_without_equilibrium_has_status_1_and_no_file(
    run: Run, quick_scene: Path, tmp_path: Path
) -> None:
    arguments = ("--set=model=full", "--set=preload.offset=1")

    status, output, error = run("frc", str(quick_scene), *arguments)

    assert (status, output) == (1, "")
    assert "equilibrium" in error
    assert len(error.splitlines()) == 1
    assert list(tmp_path.iterdir()) == [quick_scene]


@pytest.mark.parametrize(
    ("kind", "arguments", "picture"),
    [
        ("curve", (), "result.png"),
        ("curve", ("-o", "again.pdf"), "again.pdf"),
        ("history", (), "result.png"),
        ("history", ("-o", "again.svg"), "again.svg"),
    ],
)
def test_plot_draws_a_file_again(
    kind: str,
    arguments: tuple[str, ...],
    picture: str,
    run: Run,
    small_curve: ResponseCurve,
    small_history: TimeHistory,
    tmp_path: Path,
) -> None:
    result: Result = small_curve if kind == "curve" else small_history
    save(tmp_path / "result.nc", Stored(result, "", "microslip frc two-blades"))

    status, output, error = run("plot", "result.nc", *arguments)

    assert (status, error) == (0, "")
    assert output == f"picture in {picture}\n"
    assert (tmp_path / picture).stat().st_size > 1000


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("nowhere.nc",), "there is no result file nowhere.nc"),
        ((".",), "cannot be read: Is a directory"),
        (("quick.toml",), "quick.toml is not a result file"),
        (("result.nc", "-o", "x.xyz"), "x.xyz cannot be written: give an ending"),
        (("result.nc", "-o", "nowhere/x.png"), "there is no folder nowhere to write"),
    ],
)
def test_plot_that_fails_says_why(
    arguments: tuple[str, ...],
    words: str,
    run: Run,
    quick_scene: Path,
    small_curve: ResponseCurve,
    tmp_path: Path,
) -> None:
    assert quick_scene.is_file()
    save(tmp_path / "result.nc", Stored(small_curve, "", ""))

    status, output, error = run("plot", *arguments)

    assert (status, output) == (2, "")
    assert words in error
    assert len(error.splitlines()) == 1


def test_module_runs_as_the_command_does() -> None:
    command = [sys.executable, "-W", "error", "-m", "microslip", "scenes", "disc"]

    ended = subprocess.run(command, capture_output=True, text=True, check=False)

    assert ended.returncode == 2
    assert ended.stdout == ""
    assert ended.stderr.startswith("microslip: there is no built-in scene disc")


@pytest.mark.parametrize("arguments", [("scenes",), ("scenes", "two-blades")])
def test_reader_that_leaves_early_causes_no_traceback(
    arguments: tuple[str, ...],
) -> None:
    command = [sys.executable, "-m", "microslip", *arguments]

    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()
        error = process.stderr.read()

    assert error == ""


OVERFLOW = """
import sys
import numpy as np
from microslip import cli
from microslip.commands import scenes

scenes._run = lambda options: int(np.square(np.float64(1e300)) > 0.0)
sys.exit(cli.main(["scenes"]))
"""


def test_numbers_out_of_range_end_a_command_in_one_line() -> None:
    # In a process of its own: within pytest, warnings are errors in any case.
    words = [sys.executable, "-c", OVERFLOW]
    ended = subprocess.run(words, capture_output=True, text=True, check=False)

    assert ended.returncode == 1
    (line,) = ended.stderr.splitlines()
    assert line.startswith("microslip: numbers out of range (")
