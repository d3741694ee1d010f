"""Forces from files: what is read, what is refused and in which words."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.files.result_file import load
from microslip.scenes.force_file import read_force
from microslip.scenes.quantity import SceneError
from microslip.scenes.scene_file import load_scene
from microslip.studies.loads import load_history
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.results.time_history import TimeHistory
from scene_texts import EXPERIMENTS

Run: TypeAlias = Callable[..., tuple[int, str, str]]
MASS = """
scene = "system"
[structure]
names = ["x"]
mass = [1]
stiffness = [1000]
[drive]
x = "2 N"
"""


@pytest.mark.parametrize(
    "text",
    [
        "0,1\n0.5,-2\n1,3\n",
        "time [s],force [N]\n0,1\n0.5,-2\n1,3",
        "\ufeff# measured\n\nt;F\n0;1\n5e-1;-2.0\n\n1;+3\n",
        "0 1\r\n  0.5\t-2\r\n1   3\r\n",
    ],
)
def test_two_columns_are_read_with_or_without_a_header(
    text: str, tmp_path: Path
) -> None:
    path = tmp_path / "force.csv"
    path.write_text(text, encoding="utf-8")

    force = read_force(path)

    np.testing.assert_array_equal(force.time, [0.0, 0.5, 1.0])
    np.testing.assert_array_equal(force.force, [1.0, -2.0, 3.0])


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("", "no lines with numbers"),
        ("t,F\n", "no lines with numbers"),
        ("t,F\n0,1\n", "one line with numbers"),
        ("t,F\nt,F\n0,1\n1,1", "line 2: 't,F': give time"),
        (
            "0,1;1\n1;1",
            "line 1: '0,1;1': give time [s] and force [N], two numbers in "
            "each line, with a decimal point",
        ),
        (
            "0 0\n0,5 1,5",
            "line 2: '0,5 1,5': give time [s] and force [N], two numbers "
            "in each line, with a decimal point",
        ),
        ("0,1\n1,2,3\n", "line 2: '1,2,3': give time"),
        ("0,1\n1\n", "line 2: '1': give time"),
        ("0,1\n1,\n", "line 2: '1,': give time"),
        ("0,x\n1,1\n", "line 1: '0,x': give time"),
        ("0,1\n1,nan\n", "line 2: '1,nan'"),
        ("0,1\ninf,2\n", "line 2: 'inf,2'"),
        ("-1,1\n1,1\n", "line 1: time -1 s: begin at 0"),
        ("0,1\n\n2,1\n2,3", "line 4: time 2 s does not come after 2 s"),
        ("0,1\n2,1\n1,3", "line 3: time 1 s does not come after 2 s"),
    ],
)
def test_malformed_force_is_refused_with_its_line(
    text: str, hint: str, tmp_path: Path
) -> None:
    path = tmp_path / "force.csv"
    path.write_text(text, encoding="utf-8")

    with pytest.raises(SceneError) as caught:
        read_force(path)

    assert hint in str(caught.value)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_force_that_is_no_text_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "binary").write_bytes(b"\xff\xfe\x00\x80")

    with pytest.raises(SceneError, match="there is no force file"):
        read_force(tmp_path / "nowhere.csv")
    with pytest.raises(SceneError, match="cannot be read"):
        read_force(tmp_path)
    with pytest.raises(SceneError, match="is not UTF-8 text"):
        read_force(tmp_path / "binary")


def test_scene_takes_the_force_of_a_file_beside_it(quick_scene: Path) -> None:
    (quick_scene.parent / "hit.csv").write_text("0,0\n1e-3,4\n2e-3,0")
    words = ["sweep.force_file=hit.csv", "excitation.force=2"]

    scene = load_scene(str(quick_scene), words)
    history = load_history(scene)

    drive = factors_over(history.segments(), np.array([5e-3, 5.5e-3, 6e-3, 7e-3]))[:, 1]
    np.testing.assert_allclose(drive, [0.0, 1.0, 2.0, 0.0], atol=1e-9)
    assert history.duration == pytest.approx(7e-3)


def test_another_force_of_the_same_name_makes_another_scene(quick_scene: Path) -> None:
    file, words = quick_scene.parent / "hit.csv", ["sweep.force_file=hit.csv"]
    texts = []
    for content in ("0,0\n1e-3,4", "0,0\n1e-3,5"):
        file.write_text(content)
        texts.append(load_scene(str(quick_scene), words).text)

    assert texts[0] != texts[1]


def test_force_without_a_drive_is_refused(quick_scene: Path) -> None:
    (quick_scene.parent / "hit.csv").write_text("0,0\n1e-3,4")
    words = ["sweep.force_file=hit.csv", "excitation.force=0"]

    with pytest.raises(SceneError, match="give it a value"):
        load_history(load_scene(str(quick_scene), words))


@pytest.mark.usefixtures("no_picture")
def test_force_of_a_system_acts_where_its_drive_does(run: Run, tmp_path: Path) -> None:
    # a linear mass of 1 kg on 1000 N/m, without damping, pushed by 3 N from 0 on
    (tmp_path / "step.csv").write_text("0,3\n1,3\n")
    path = tmp_path / "mass.toml"
    path.write_text(MASS + EXPERIMENTS, encoding="utf-8")

    status, _, error = run("sweep", str(path), "--set", "sweep.force_file=step.csv")

    assert (status, error) == (0, "")
    history = load(tmp_path / "mass-sweep.nc").result
    assert isinstance(history, TimeHistory)
    expected = 3e-3 * (1.0 - np.cos(np.sqrt(1000.0) * history.time))
    np.testing.assert_allclose(history.displacement[:, 0], expected, atol=2e-5)


@pytest.mark.parametrize(
    ("scene", "words", "hint"),
    [
        ("bladed-disk", ["solve=disk", "sectors=3"], "give one [drive] without phase"),
        ("jenkins", ["drive.x={amplitude = 1, phase = 1}"], "without phase"),
        ("chain", ["drive.x1=1"], "give one [drive]"),
        ("jenkins", ["drive.x=0"], "[drive] x = 0 N"),
    ],
)
def test_force_without_one_drive_along_which_to_act_is_refused(
    scene: str, words: list[str], hint: str, run: Run, tmp_path: Path
) -> None:
    (tmp_path / "step.csv").write_text("0,3\n1,3\n")
    sets = [
        part
        for each in ("sweep.force_file=step.csv", *words)
        for part in ("--set", each)
    ]

    status, output, error = run("sweep", scene, *sets)

    assert (status, output) == (2, "")
    assert hint in error
    assert error.count("\n") == 1
