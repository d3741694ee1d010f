"""A scene without contacts, by each command that follows its motion."""

import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.files.result_file import load
from microslip_mechanics.results.response_curve import ResponseCurve
from scene_texts import EXPERIMENTS

Run: TypeAlias = Callable[..., tuple[int, str, str]]
LINEAR = """
scene = "system"
[structure]
names = ["x"]
mass = [1]
stiffness = [1000]
damping_ratio = 0.02
[drive]
x = "0.5 N"
"""


@pytest.fixture
def linear(tmp_path: Path) -> str:
    """Return the path of a scene of one mass on a spring."""
    path = tmp_path / "linear.toml"
    path.write_text(LINEAR + EXPERIMENTS, encoding="utf-8")
    return str(path)


@pytest.mark.usefixtures("no_picture")
def test_frc_draws_the_curve_of_the_closed_form(
    run: Run, linear: str, tmp_path: Path
) -> None:
    status, _, error = run("frc", linear)

    assert (status, error) == (0, "")
    curve = load(tmp_path / "linear-frc.nc").result
    assert isinstance(curve, ResponseCurve)
    assert curve.normal_smallest.shape == (curve.frequency.size, 0)
    turns = curve.frequency
    stiffness = 1000.0 - turns**2 + 0.04j * math.sqrt(1000.0) * turns
    np.testing.assert_allclose(curve.amplitude[:, 0], 0.5 / abs(stiffness), rtol=1e-6)


@pytest.mark.usefixtures("no_picture")
def test_follow_finds_what_the_drive_is_proportional_to(
    run: Run, linear: str, tmp_path: Path
) -> None:
    status, _, error = run("follow", linear, "drive.x", "0.1", "1", "--frequency", "5")

    assert (status, error) == (0, "")
    curve = load(tmp_path / "linear-follow.nc").result
    assert isinstance(curve, ResponseCurve)
    share = curve.amplitude[:, 0] / curve.parameter
    np.testing.assert_allclose(share, share[0], rtol=1e-6)


@pytest.mark.usefixtures("no_picture")
@pytest.mark.parametrize(
    ("words", "shown"),
    [
        (["track", "drive.x", "0.1", "0.2"], r"5\.030908  ± \de-11 +5\.001000 "),
        (["verify", "--slower", "--frequencies", "2"], "agree: "),
        (["jumps"], "sweeps do not jump"),
    ],
    ids=lambda words: words[0],
)
def test_commands_that_trace_a_curve_take_it(
    words: list[str], shown: str, run: Run, linear: str
) -> None:
    command, *more = words

    status, output, error = run(command, linear, *more)

    assert (status, error) == (0, "")
    assert re.search(shown, output)


@pytest.mark.usefixtures("no_picture")
def test_frc_tells_what_its_error_does_not_count(run: Run, tmp_path: Path) -> None:
    path = tmp_path / "joint.toml"
    joint = """
[structure.reduction]
highest = "50 Hz"
[[element]]
name = "joint"
law = "iwan"
between = ["x", "ground"]
slip_force = 2
stiffness = 300
chi = -0.5
beta = 0.5
sliders = 5
"""
    path.write_text(LINEAR + joint + EXPERIMENTS, encoding="utf-8")

    status, output, error = run("frc", str(path), "--set", "curve.harmonics=1")

    assert (status, error) == (0, "")
    reduction, sliders, _ = output.splitlines()[-3:]
    assert reduction.startswith(
        "not in these errors: the reduction to modes up to 50 Hz, "
    )
    assert sliders == (
        "not in these errors: element joint is 5 sliders, whose force is up to "
        "4.5e-02 of slip_force above its law's: more of them, or a smaller "
        "element.joint.smallest, are nearer to it"
    )
