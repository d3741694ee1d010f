"""A wedge under a blade's platform, which nothing but two frictional contacts holds."""

import functools
from collections.abc import Iterable, Iterator

import pytest

from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.curve import Traced, trace_curve
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.shooting.comparison import compared

AT_ITS_LIMIT, SLIDING, HARD = 285.6, 288.0, 288.5
"""frequencies [Hz]: the wedge has slipped until it no longer does; it slips; it slips,
and its drive leads to no first point at once"""


@functools.cache
def traced(frequency: float, *overrides: str) -> tuple[Problem, Traced]:
    span = f"curve.lowest={frequency}", f"curve.highest={frequency + 0.01}"
    scene = load_scene("platform-damper", (*span, *overrides))
    problem = problem_of(scene)
    return problem, trace_curve(problem, scene.curve, first)


def first(points: Iterable[PeriodicResponse]) -> Iterator[PeriodicResponse]:
    """Yield the first point alone: the next ones say nothing more."""
    yield next(iter(points))


@pytest.mark.parametrize("frequency", [AT_ITS_LIMIT, SLIDING])
def test_amplitudes_scale_with_all_loads(frequency: float) -> None:
    # linear springs, dampers and friction that is proportional to the pressure
    _, whole = traced(frequency)
    _, half = traced(frequency, "preload.wedge.ux=100", "drive.tip.uz=1")

    found, expected = half.curve, whole.curve
    assert found.amplitude[0] == pytest.approx(0.5 * expected.amplitude[0], rel=1e-6)
    assert found.friction_energy[0] == pytest.approx(
        0.25 * expected.friction_energy[0], rel=1e-5, abs=1e-12
    )


@pytest.mark.parametrize(("frequency", "most"), [(AT_ITS_LIMIT, 1e-7), (HARD, 7e-4)])
def test_both_solvers_agree(frequency: float, most: float) -> None:
    problem, found = traced(frequency)
    slid = found.curve.friction_energy[0]
    assert slid > 1e-3 if frequency == HARD else slid == pytest.approx(0.0, abs=1e-9)

    comparison = compared(problem, found.responses[0])

    assert comparison.as_estimated
    assert comparison.difference < most  # measured: 5e-9 and 4.7e-4
    assert comparison.as_stable
