"""Peaks and folds lie no farther from their true places than their errors say."""

from collections.abc import Iterator

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.rigs import problem_of
from microslip.scene_file import load_scene
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

MARKS = ("peak", "fold")
SCENES = (
    ("duffing",),
    ("gap",),
    ("gap", "drive.x=0.3"),
    ("jenkins",),
    ("jenkins", "drive.x=0.7"),
    ("jenkins", "drive.x=2"),
)
TOLERANCES = (1e-2, 3e-3, 1e-3, 3e-4)
FINEST = 3e-6


def marked(
    name: str, *sets: str, error: float, harmonics: int | None = None
) -> list[PeriodicResponse]:
    """Return the peaks and folds of a built-in scene's curve."""
    scene = load_scene(name, sets)
    problem, span = problem_of(scene), scene.curve
    options = CurveOptions(
        2.0 * np.pi * span.lowest,
        2.0 * np.pi * span.highest,
        error=error,
        harmonics=harmonics,
        stability=False,
    )
    points = frequency_response(problem, static_equilibrium(problem), options)
    return [each for each in points if each.event in MARKS]


def compared(*scene: str) -> Iterator[tuple[float, float, float]]:
    """Yield error, estimate and doubt of each peak and fold, in rad/s."""
    finest = marked(*scene, error=FINEST)
    for tolerance in TOLERANCES:
        for each in marked(*scene, error=tolerance):
            alike = [known for known in finest if known.event == each.event]
            true = min(alike, key=lambda known: abs(known.frequency - each.frequency))
            error = abs(true.frequency - each.frequency)
            yield error, each.parameter_error, true.parameter_error


def test_errors_of_peaks_and_folds_bound_the_true_ones_and_are_not_far_above() -> None:
    every = np.array([row for scene in SCENES for row in compared(*scene)])
    true, estimated, doubt = every.T
    known = doubt < 0.3 * true  # else the finest curve does not know better

    assert known.sum() >= 25
    share = estimated[known] / true[known]
    assert share.min() >= 1.0  # measured 1.4
    assert np.median(share) <= 5.0  # measured 3.0
    # the others are as far from the finest curve as both say at the most
    assert np.all(true <= estimated + doubt)


@pytest.mark.parametrize("harmonics", [3, 7])
def test_errors_with_fixed_harmonics_bound_the_true_ones(harmonics: int) -> None:
    finest = marked("gap", error=FINEST)

    for each in marked("gap", error=1e-3, harmonics=harmonics):
        alike = [known for known in finest if known.event == each.event]
        true = min(abs(known.frequency - each.frequency) for known in alike)
        assert 0.0 < true <= each.parameter_error


def test_other_points_have_no_such_error() -> None:
    scene = load_scene("gap")
    problem = problem_of(scene)
    options = CurveOptions(2.0 * np.pi * 5.4, 2.0 * np.pi * 5.7)
    points = frequency_response(problem, static_equilibrium(problem), options)

    for each in points:
        assert np.isfinite(each.parameter_error) == (each.event in MARKS)
