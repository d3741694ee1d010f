"""The response against a parameter of the scene, and the command that draws it."""

import math
from collections.abc import Iterator
from itertools import takewhile
from pathlib import Path

import numpy as np
import pytest
from scipy.io import netcdf_file

from hbm.curves.drive_search import Sought
from hbm.errors import PLACE, ContinuationError
from microslip.cli import main
from microslip.files.result_file import load
from microslip.scenes.quantity import SceneError
from microslip.studies.curve import trace_curve
from microslip.studies.follow import follow
from microslip.studies.parameter import parameter, told_along
from microslip_mechanics.results.response_curve import ResponseCurve

STICKY = ("model=A", "friction.mu_dynamic=50", "friction.mu_static=50")

BESIDE_REGULARISED = """
scene = "system"
structure = {mass = [1], stiffness = [[1e4]], damping_ratio = 0.02}
drive = {x1 = 0.5}
curve = {lowest = 10, highest = 30, harmonics = 3, samples = 64}
[[element]]
name = "slider"
law = "jenkins"
between = ["x1", "ground"]
stiffness = 5e3
limit = 1
[[element]]
name = "rubbing"
law = "coulomb"
tangents = [["x1", "ground"]]
load = 1
mu = 0.1
threshold_velocity = 1
"""
"""A slider beside regularised friction: the stability is not known (theory §6.5)."""


def test_a_sticking_rig_answers_in_proportion_to_the_drive() -> None:
    drive = parameter("two-blades", STICKY, "excitation.force", "500 mN", "2")

    curve = follow(drive, math.tau * 134.5)

    assert curve.ending == "complete"
    assert curve.along == "excitation.force [N]"
    assert curve.parameter[0] == 0.5
    assert curve.parameter[-1] == 2.0
    compliance = curve.amplitude / curve.parameter[:, None]
    np.testing.assert_allclose(
        compliance, np.broadcast_to(compliance[0], compliance.shape), rtol=1e-5
    )


def test_a_curve_from_zero_begins_at_zero() -> None:
    fixed = ("curve.harmonics=7", "curve.samples=128")
    gap = parameter("gap", fixed, "element.stop.gap", "0", "0.2 mm")

    curve = follow(gap, math.tau * 5.2)

    assert curve.ending == "complete"
    assert curve.parameter[0] == 0.0


def test_a_drive_of_nothing_is_a_wrong_scene(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["duffing", "drive.y", "0.1", "0.2", "--frequency", "5"]

    assert main(["follow", *words, "-o", str(tmp_path / "x")]) == 2

    told = capsys.readouterr().err
    expected = "duffing: drive: there is no degree of freedom 'y': give one of x"
    assert told == f"microslip: {expected}\n"


def test_it_meets_the_frequency_response_at_the_scene_s_value() -> None:
    overrides = ("curve.lowest=18 Hz", "curve.highest=18.2 Hz")
    drive = parameter("jenkins", overrides, "drive.x", "0.3", "0.5")

    followed = follow(drive, math.tau * 18.0)
    curve = trace_curve(drive.problem_at(0.5), drive.scene.curve).curve

    np.testing.assert_allclose(followed.amplitude[-1], curve.amplitude[0], rtol=2e-3)


@pytest.mark.parametrize(
    ("name", "first", "last", "text"),
    [
        ("blade.elements", "3", "4", "blade.elements cannot be followed"),
        ("model", "A", "B", "model cannot be followed"),
        ("excitation.force", "1", "1 N", "give two different values"),
        ("excitation.force", "1", "1.0000000000000002", "give two different values"),
        ("excitation.farce", "1", "2", "do you mean force"),
        ("curve.lowest", "120", "125", "curve.lowest cannot be followed"),
    ],
)
def test_what_cannot_be_followed_is_refused(
    name: str, first: str, last: str, text: str
) -> None:
    with pytest.raises(SceneError, match=text):
        parameter("two-blades", (), name, first, last)


def rows_of(said: str) -> list[str]:
    """Return the rows of the table that a command begins with."""
    table = takewhile(lambda line: "estimated" not in line, said.splitlines())
    return list(table)[2:]


def test_a_multiplier_that_is_not_known_is_no_number(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "both.toml"
    scene.write_text(BESIDE_REGULARISED)
    words = ["follow", str(scene), "drive.x1", "0.5", "0.6", "--frequency", "20"]

    assert main([*words, "-o", str(tmp_path)]) == 0
    rows = rows_of(capsys.readouterr().out)

    curve = load(tmp_path / "both-follow.nc").result
    assert isinstance(curve, ResponseCurve)
    assert (curve.unstable == -1).all()
    assert len(rows) >= 12
    assert all(row.split()[-1] == "-" for row in rows)


def test_the_command_keeps_a_curve_that_can_be_drawn_again(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["follow", "two-blades", "excitation.force", "0.5", "1"]
    words += ["--frequency", "134.5", "-o", str(tmp_path / "drive")]
    words += [word for each in STICKY for word in ("--set", each)]

    assert main(words) == 0
    assert "excitation.force" not in capsys.readouterr().err
    stored = load(tmp_path / "drive.nc").result
    assert isinstance(stored, ResponseCurve)
    assert stored.along == "excitation.force [N]"
    with netcdf_file(tmp_path / "drive.nc", mmap=False) as file:
        assert getattr(file.variables["parameter"], "units") == b"N"  # noqa: B009
    assert (tmp_path / "drive.png").stat().st_size > 10_000
    again = tmp_path / "again.png"
    assert main(["plot", str(tmp_path / "drive.nc"), "-o", str(again)]) == 0
    assert again.stat().st_size > 10_000


@pytest.mark.long
def test_frc_says_that_nothing_is_detached(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    short = (*STICKY, "curve.lowest=134 Hz", "curve.highest=134.1 Hz")
    words = ["frc", "two-blades", "--detached", "--branches"]
    words += [word for each in short for word in ("--set", each)]

    assert main([*words, "-o", str(tmp_path / "curve")]) == 0
    output = capsys.readouterr().out
    assert "no detached curve was found" in output
    sought = "sought at 15 of 15 frequencies, 134.003 to 134.097 Hz, by 0.05 to 4 times"
    assert sought in output
    assert "only up to" not in output


@pytest.mark.parametrize("barren", [True, pytest.param(False, marks=pytest.mark.long)])
def test_a_branch_point_without_a_branch_is_named(
    barren: bool,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    if barren:
        monkeypatch.setattr("microslip.studies.curve.branches", lambda *_: iter(()))
    loud = ("drive.x=26.8 N", "structure.damping_ratio=0.1", "curve.highest=8 Hz")
    words = [word for each in loud for word in ("--set", each)]

    curve = str(tmp_path / "curve")
    assert main(["frc", "duffing", *words, "--branches", "-o", curve]) == 0

    lines = capsys.readouterr().out.splitlines()
    places = [line.split()[2] for line in lines if line.startswith("branch point")]
    missing = [line.split()[-2] for line in lines if line.startswith("no branch is")]
    assert len(places) == 2
    assert missing == (places if barren else [])


@pytest.mark.parametrize("frequencies", [0, 3])
def test_an_interrupted_search_says_how_far_it_was(
    frequencies: int,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def interrupted(*_: object, **__: object) -> Iterator[Sought]:
        for number in range(frequencies):
            yield Sought(math.tau * (134.0 + 0.1 * number), 1.5, "too hard", "")
        raise KeyboardInterrupt

    monkeypatch.setattr("microslip.studies.detached.detached", interrupted)
    short = (*STICKY, "curve.lowest=134 Hz", "curve.highest=134.5 Hz")
    words = ["frc", "two-blades", "--detached"]
    words += [word for each in short for word in ("--set", each)]

    assert main([*words, "-o", str(tmp_path / "curve")]) == 130
    printed = capsys.readouterr()
    assert printed.err == "microslip: interrupted; what was computed is kept\n"
    if frequencies == 0:
        assert "no detached curve was sought" in printed.out
    else:
        assert "sought at 3 of 15 frequencies, 134.000 to 134.200 Hz" in printed.out
        assert "at 134.100 Hz only up to 1.5 times the drive: too hard" in printed.out
    stored = load(tmp_path / "curve.nc").result
    assert isinstance(stored, ResponseCurve)
    assert stored.ending == "interrupted"
    assert stored.frequency.size > 5


def test_a_negative_value_with_an_exponent_is_a_value(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["follow", "gap", "drive.x", "-1.2e-2", "-1e-2", "--frequency", "4.5"]

    status = main([*words, "-o", str(tmp_path / "phase")])

    assert status == 0
    assert "-0.012" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("label", "place"), [("drive.x [N]", "drive.x = 0.25 N"), ("mu", "mu = 0.25")]
)
def test_errors_along_a_parameter_name_it(label: str, place: str) -> None:
    def lost() -> Iterator[int]:
        yield 1
        raise ContinuationError(f"it is lost at {PLACE}: try less", 0.25)

    points = told_along(lost(), label)

    assert next(points) == 1
    with pytest.raises(ContinuationError, match=f"^it is lost at {place}: try less$"):
        next(points)


def test_the_table_of_a_drive_that_vanishes_is_spread_along_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["follow", "duffing", "drive.x", "0.2", "0", "--frequency", "5.2"]

    assert main([*words, "-o", str(tmp_path / "a")]) == 0

    rows = rows_of(capsys.readouterr().out)
    drives = [float(row.split()[0]) for row in rows]
    assert sum(drive < 0.002 for drive in drives) <= 2
    assert len(drives) >= 10
