"""Peaks of a curve lie where the motion with many harmonics has them."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import scipy.optimize

from hbm.curves.periodic_response import settled_response
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

HERTZ = 2.0 * np.pi
RISING = """
scene = "system"
[structure]
names = ["x1", "x2"]
mass = [1, 1]
stiffness = [[20_000, -10_000], [-10_000, 10_000]]
damping_ratio = 0.005
[[element]]
name = "slider"
law = "coulomb"
tangents = [["x1", "ground"]]
mu = 0.5
threshold_velocity = 1e-4
load = 2
[drive]
x2 = "0.5 N"
[curve]
lowest = "13 Hz"
highest = "14 Hz"
"""


def peak_of(problem: Problem, options: CurveOptions) -> PeriodicResponse:
    """Return the highest peak that a curve has."""
    points = frequency_response(problem, static_equilibrium(problem), options)
    peaks = [each for each in points if each.event == "peak"]
    return max(peaks, key=lambda each: largest(problem, each))


def largest(problem: Problem, response: PeriodicResponse) -> float:
    """Return the largest first-harmonic amplitude of a probe [m]."""
    first = response.coefficients[1:3] @ problem.probes.rows.T
    return float(np.linalg.norm(first, axis=0).max())


def dense_peak(problem: Problem, near: PeriodicResponse, aside: float) -> float:
    """Return where single points, hardly in error, are highest [Hz]."""
    rest = static_equilibrium(problem)

    def lowness(hertz: float) -> float:
        guess = replace(near, frequency=HERTZ * hertz)
        point = settled_response(problem, rest, guess, error=1e-6)
        return -largest(problem, point)

    centre = near.frequency / HERTZ
    limits = (centre - aside, centre + aside)
    found = scipy.optimize.minimize_scalar(lowness, bounds=limits, method="bounded")
    return float(found.x)


@pytest.mark.parametrize(
    ("name", "error", "aside", "near"),
    # With as many harmonics as the curve needs they are 0.0024 and 0.08 Hz aside.
    [("duffing", 1e-2, 0.003, 1e-4), ("jenkins", 1e-3, 0.08, 0.02)],
)
def test_the_highest_peak_is_where_single_points_have_it(
    name: str, error: float, aside: float, near: float
) -> None:
    scene = load_scene(name)
    problem, span = problem_of(scene), scene.curve
    options = CurveOptions(HERTZ * span.lowest, HERTZ * span.highest, error=error)

    peak = peak_of(problem, options)

    place = peak.frequency / HERTZ
    assert place == pytest.approx(dense_peak(problem, peak, aside), abs=near)


def test_a_curve_that_rises_to_its_end_has_no_peak_there(tmp_path: Path) -> None:
    # x2 does not depend on the motion of the contact alone.
    path = tmp_path / "rising.toml"
    path.write_text(RISING)
    scene = load_scene(str(path))
    problem, span = problem_of(scene), scene.curve
    options = CurveOptions(HERTZ * span.lowest, HERTZ * span.highest, error=1e-2)

    points = list(frequency_response(problem, static_equilibrium(problem), options))

    assert largest(problem, points[-1]) > largest(problem, points[-2])
    assert not [each.event for each in points if each.event]
