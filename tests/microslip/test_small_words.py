"""What is said of names that are none, and of scenes without friction."""

import os
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

import microslip
from microslip.commands.sweep_tables import estimates
from microslip_mechanics.results.extremes import extremes
from microslip_mechanics.results.time_history import TimeHistory

Run: TypeAlias = Callable[..., tuple[int, str, str]]


@pytest.mark.parametrize(
    ("name", "said"),
    [("", "^a scene of no name"), ("a\0b", r"^a\\0b cannot be read: embedded null")],
)
def test_a_scene_of_no_possible_name_is_refused(name: str, said: str) -> None:
    with pytest.raises(microslip.MicroslipError, match=said):
        microslip.scene(name)


@pytest.mark.parametrize("function", ["save", "load"])
def test_a_path_that_no_file_has_is_refused(
    function: str, small_history: TimeHistory
) -> None:
    given = (small_history, "a\0b.nc") if function == "save" else ("a\0b.nc",)

    with pytest.raises(
        microslip.MicroslipError, match=rf"^microslip\.{function}: path = 'a\\x00b.nc'"
    ):
        getattr(microslip, function)(*given)


def test_a_report_goes_into_no_file(run: Run, quick_scene: Path) -> None:
    status, output, error = run("report", str(quick_scene), "-o", quick_scene.name)

    assert (status, output) == (2, "")
    assert error == (
        "microslip: quick.toml is a file: the page goes into a folder, give the name "
        "of one\n"
    )


@pytest.mark.parametrize("command", ["frc", "modes", "dwell"])
def test_a_result_has_no_name_of_a_scene(
    run: Run, quick_scene: Path, command: str
) -> None:
    more = ("--frequency", "135") if command == "dwell" else ()

    status, output, error = run(
        command, str(quick_scene), *more, "-o", quick_scene.name
    )

    assert (status, output) == (2, "")
    assert error.startswith("microslip: -o quick.toml is the name of a scene, not of a")
    assert not quick_scene.with_name("quick.toml.nc").exists()


def test_a_result_does_not_stand_beside_a_pipe(run: Run, tmp_path: Path) -> None:
    """As root ``-o /dev/null`` would make a file /dev/null.nc."""
    os.mkfifo(tmp_path / "pipe")

    status, output, error = run("frc", "duffing", "-o", "pipe")

    assert (status, output) == (2, "")
    assert error == (
        "microslip: -o pipe is no file: results would stand beside it, with endings: "
        "give a folder, or a path without ending\n"
    )
    assert [each.name for each in tmp_path.iterdir()] == ["pipe"]


@pytest.mark.parametrize("command", ["tables", "grid two-blades"])
def test_a_table_is_not_written_over_a_scene(
    tmp_path: Path, run: Run, command: str
) -> None:
    scene = tmp_path / "mine.toml"
    scene.write_text("mine")

    status, _, error = run(*command.split(), "--csv", "mine.toml")

    assert status == 2
    assert error == (
        "microslip: --csv mine.toml is the name of a scene, not of a result: give one "
        "that ends with .csv, or has no ending\n"
    )
    assert scene.read_text() == "mine"


@pytest.mark.parametrize(("name", "sticks"), [("gap", False), ("jenkins", True)])
def test_modes_stick_where_there_is_friction(
    name: str, run: Run, monkeypatch: pytest.MonkeyPatch, *, sticks: bool
) -> None:
    monkeypatch.setattr("microslip.files.store.save_figure", lambda *_: None)
    few = ("--amplitudes", "0.001", "0.002", "--range", "1", "100")

    status, output, _ = run("modes", name, *few)

    assert status == 0
    assert ("while its contacts stick" in output) == sticks
    *_, error = run("modes", name, "--range", "1e5 Hz", "2e5 Hz")
    assert "no mode has a natural frequency in this range" in error
    assert "the nearest is " in error
    assert ("while its contacts stick" in error) == sticks


@pytest.mark.parametrize(("rest", "rubs"), [(1.0, True), (1e-18, False), (0.0, False)])
def test_errors_of_friction_are_told_where_there_is_some(
    small_history: TimeHistory, rest: float, *, rubs: bool
) -> None:
    place = list(small_history.energies).index("friction")
    small_history.energy[:, place] *= rest

    lines = "\n".join(estimates(small_history, extremes(small_history)))

    assert ("friction, error" in lines) == rubs
    assert "estimated error of the peak amplitude" in lines


def test_the_error_of_a_reduction_is_asked_at_a_frequency() -> None:
    reduced = microslip.reduced_problem(microslip.scene("chain"), "100 Hz")

    assert reduced.error("0.001 kHz") == reduced.error(1.0)
    for given in (np.nan, "1 m", -1.0):
        with pytest.raises(ValueError, match=r"^error: hertz = .*: (is|has) "):
            reduced.error(given)


PRESSED_AND_LOADED = """
scene = "system"

[structure]
mass = [1]
stiffness = [[1e4]]
damping_ratio = 0.01

[[element]]
name = "stop"
law = "unilateral-spring"
between = ["x1", "ground"]
stiffness = 1e4
preload = 2

[[element]]
name = "rubs"
law = "coulomb"
tangents = [["x1", "ground"]]
mu = 0.1
load = 5
threshold_velocity = 1e-2

[drive]
x1 = 0.5

[curve]
lowest = 5
highest = 5.1
harmonics = 3
samples = 64
"""


def test_forces_at_rest_are_those_of_contacts_that_have_some(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("microslip.files.store.save_figure", lambda *_: None)
    (tmp_path / "both.toml").write_text(PRESSED_AND_LOADED)

    status, output, _ = run("frc", str(tmp_path / "both.toml"))

    assert status == 0
    assert "normal force at rest [N]: stop 1.000\n" in output
