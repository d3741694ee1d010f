"""Folds of curves by tolerance are those of many harmonics, whichever way one goes."""

import functools

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium

HERTZ = 2.0 * np.pi


def curve(start: float, end: float, **options: float) -> list[PeriodicResponse]:
    """Return the curve of Duffing's oscillator, wide open under 0.5 N."""
    problem = problem_of(load_scene("duffing", ("drive.x=0.5",)))
    wanted = CurveOptions(HERTZ * start, HERTZ * end, **options)  # type: ignore[arg-type]
    return list(frequency_response(problem, static_equilibrium(problem), wanted))


def events(responses: list[PeriodicResponse]) -> list[tuple[float, str]]:
    """Return frequency [Hz] and name of what happens on a curve, in their order."""
    marked = [each for each in responses if each.event]
    return sorted((each.frequency / HERTZ, each.event) for each in marked)


@functools.cache
def known() -> list[tuple[float, str]]:
    return events(curve(4.0, 9.0, harmonics=15, samples=256))


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-8])
@pytest.mark.parametrize(("start", "end"), [(9.0, 5.8), (9.0, 4.0), (4.0, 9.0)])
def test_folds_are_those_of_many_harmonics(
    start: float, end: float, tolerance: float
) -> None:
    found = events(curve(start, end, error=tolerance))

    assert [name for _, name in found] == [name for _, name in known()]
    for (place, _), (exact, _) in zip(found, known(), strict=True):
        assert place == pytest.approx(exact, rel=5e-6)


def softening(tolerance: float) -> list[tuple[float, str]]:
    """Return the events of a mass on a spring that softens, under 0.15 N."""
    sets = ("drive.x=0.15", "element.cubic.cubic=-2e7")
    problem = problem_of(load_scene("duffing", sets))
    wanted = CurveOptions(HERTZ * 3.5, HERTZ * 5.5, error=tolerance)
    return events(
        list(frequency_response(problem, static_equilibrium(problem), wanted))
    )


def test_more_harmonics_do_not_leap_across_the_tip_of_a_resonance() -> None:
    # both sides of the tip are as close as three and seven harmonics are
    found = softening(1e-3)

    assert [name for _, name in found] == ["fold", "peak", "fold"]
    for (place, _), (exact, _) in zip(found, softening(1e-5), strict=True):
        assert place == pytest.approx(exact, rel=2e-5)
