"""Curves that are nothing but creep of friction that sticks are told, and cheap."""

import re
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import numpy as np
import pytest

from microslip.files.result_file import load
from microslip_mechanics.results.response_curve import ResponseCurve

Run: TypeAlias = Callable[..., tuple[int, str, str]]
SCENE = """
scene = "system"
[structure]
names = ["a", "b"]
mass = [1, 1]
stiffness = [[20000, -10000], [-10000, 10000]]
[[element]]
name = "rub"
law = {law}
tangents = [["b", "ground"]]
load = "100 N"
mu = 0.5
[drive]
{place} = "{force}"
[curve]
lowest = "8 Hz"
highest = "20 Hz"
"""
RIGID = '"rigid-coulomb"'
REGULARISED = '"coulomb"\nthreshold_velocity = 1e-4'


def scene(folder: Path, law: str, place: str, force: str = "1 N") -> str:
    """Write a scene of two undamped masses, one of which rubs; return its file."""
    path = folder / "rub.toml"
    path.write_text(SCENE.format(law=law, place=place, force=force), encoding="utf-8")
    return str(path)


@pytest.mark.usefixtures("no_picture")
def test_creep_of_rigid_friction_is_told_and_takes_few_harmonics(
    run: Run, tmp_path: Path
) -> None:
    status, output, _ = run("frc", scene(tmp_path, RIGID, "b"), "-o", "curve")

    assert status == 0
    assert re.search(r"what moves, at most \S+e-10 mm, is creep of friction", output)
    assert "take it for zero" in output
    curve = load(tmp_path / "curve.nc").result
    assert isinstance(curve, ResponseCurve)
    assert curve.harmonics.max() <= 31
    # η F / |m s² + c s|, of the mass that rubs, with c = 0.2 m times the highest one
    slow, high = curve.frequency[0], curve.frequency.max()
    expected = 1e-9 / (slow * np.hypot(slow, 0.2 * high))
    assert curve.amplitude[0].max() == pytest.approx(expected, rel=0.02)


@pytest.mark.usefixtures("no_picture")
def test_below_the_threshold_velocity_regularised_friction_creeps(
    run: Run, tmp_path: Path
) -> None:
    status, output, _ = run("frc", scene(tmp_path, REGULARISED, "b"), "-o", "curve")

    assert status == 0
    assert "up to the threshold velocity of friction, 0.0001 m/s" in output


@pytest.mark.usefixtures("no_picture")
@pytest.mark.parametrize("law", [RIGID, REGULARISED])
@pytest.mark.parametrize(("place", "force"), [("a", "1 N"), ("b", "56 N")])
def test_where_something_moves_or_slides_nothing_is_said(
    run: Run, tmp_path: Path, law: str, place: str, force: str
) -> None:
    path = scene(tmp_path, law, place, force)
    coarse = "--set", "curve.tolerance=1e-2"

    status, output, _ = run("frc", path, "-o", "curve", *coarse)

    assert status == 0
    assert "creep" not in output
