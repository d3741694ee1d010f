"""Where a curve has its first point: behind folds, or from a response of more."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from hbm.curves.tracer import Tracer
from hbm.options import CurveOptions
from hbm.paths.along_parameter import AlongParameter
from hbm.paths.path import along_frequency
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from timedomain.shooting.comparison import compared
from timedomain.shooting.shooting import ShootingOptions

TURN = 2.0 * np.pi


def test_a_duffing_curve_that_rest_does_not_begin_begins_behind_folds() -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    options = CurveOptions(TURN * 5.8, TURN * 9.0, stability=False)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    assert curve[0].frequency == TURN * 5.8
    assert curve[-1].frequency == TURN * 9.0
    assert "restart" not in [each.event for each in curve]


@pytest.mark.parametrize(("scene", "hertz"), [("duffing", 5.4), ("gap", 5.2)])
def test_a_first_point_behind_folds_of_the_drive_is_reached_along_them(
    scene: str, hertz: float
) -> None:
    # From rest the motion leaps at a fold at which the drive has not grown whole.
    problem = problem_of(load_scene(scene, ["drive.x=0.1"]))
    whole = CurveOptions(TURN * 4.0, TURN * 7.0, stability=False)
    curve = list(frequency_response(problem, static_equilibrium(problem), whole))

    def driven(share: float) -> Problem:
        return replace(problem, drive=share * problem.drive)

    path = AlongParameter(driven, TURN * hertz, 1.0, 2.0)
    tracer = Tracer(problem, path, CurveOptions(1.0, 2.0, stability=False))
    first = next(iter(tracer.responses()))

    places = np.array([each.frequency for each in curve]) / TURN
    heights = np.array([np.hypot(*each.coefficients[1:3, 0]) for each in curve])
    reached = np.hypot(*first.coefficients[1:3, 0])
    passes = np.flatnonzero((places[:-1] - hertz) * (places[1:] - hertz) <= 0.0)
    known = [np.interp(hertz, places[n : n + 2], heights[n : n + 2]) for n in passes]
    assert first.parameter == 1.0
    assert min(abs(each / reached - 1.0) for each in known) < 0.02


@pytest.mark.parametrize("limit", [{"harmonics": 1}, {"most_harmonics": 1}])
@pytest.mark.parametrize("harmonics", [3, 7, 15])
def test_a_curve_of_few_harmonics_goes_on_from_a_response_of_more(
    harmonics: int, limit: dict[str, Any]
) -> None:
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    start, end = TURN * 6.8, TURN * 9.0
    path = along_frequency(problem, static_equilibrium(problem), start, end)
    tracer = Tracer(problem, path, CurveOptions(start, end, stability=False, **limit))

    found = tracer.pieces.restart.settled(np.zeros((2 * harmonics + 1, 1)), start)

    assert found is not None
    assert found[-1] == start
    assert np.abs(found[1:3]).max() > 1e-4
    np.testing.assert_array_equal(found[3:-1], 0.0)


def test_a_curve_begins_with_the_harmonics_that_its_first_point_has_settled_with() -> (
    None
):
    # what follows from an error far below the tolerance may be too few to find it again
    problem = problem_of(load_scene("duffing", ["drive.x=0.5"]))
    start, end = TURN * 6.8, TURN * 9.0
    path = along_frequency(problem, static_equilibrium(problem), start, end)
    tracer = Tracer(problem, path, CurveOptions(start, end, stability=False))

    found = tracer.pieces.restart.settled(np.zeros((31, 1)), start)

    assert found is not None
    assert tracer.system.settled.harmonics == 15
    assert tracer.system.fourier == tracer.system.settled


def test_a_rig_whose_coarse_responses_differ_has_a_first_point() -> None:
    """Model B that slides by 4 mm with friction that falls with speed."""
    problem = rig_problem(
        model="B",
        friction__law="gkf",
        friction__mu_dynamic=5.0,
        friction__mu_static=10.0,
        friction__threshold_velocity=1e-2,
        contact__sigma=3e-9,
        preload__force=1.0,
        excitation__force=100.0,
    )
    options = CurveOptions(TURN * 125.0, TURN * 125.1, stability=False, events=False)

    curve = frequency_response(problem, static_equilibrium(problem), options)

    first = next(curve)
    assert first.frequency == TURN * 125.0
    assert first.error < options.error


@pytest.mark.parametrize(
    ("mass", "stiffness", "damping", "drive", "stop", "preload", "hertz"),
    [
        (1.4, 2.54e6, 249.0, 1560.0, 4.88e7, 2665.0, 125.7),
        pytest.param(1.0, 1e4, 4.0, 4.0, 3e5, 31.0, 4.77, marks=pytest.mark.slow),
    ],
)
def test_a_mass_that_is_lifted_off_a_pressed_spring_has_a_first_point(
    mass: float,
    stiffness: float,
    damping: float,
    drive: float,
    stop: float,
    preload: float,
    hertz: float,
) -> None:
    # A drive that grows leads to the corner where the mass first lifts off, far below
    # the whole drive, and from there through fold after fold.
    problem = system(
        mass=[mass],
        stiffness=[stiffness],
        damping=[damping],
        elements=[Element(UnilateralSpring(stop, preload=preload), ("x1", "ground"))],
        drive={"x1": drive},
    )
    options = CurveOptions(TURN * hertz, TURN * 2.0 * hertz, events=False)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    # many harmonics: steps of the march are as short as their error asks for
    found = compared(problem, first, ShootingOptions(error=1e-4))
    assert first.frequency == TURN * hertz
    assert first.normal_smallest[0] == 0.0
    assert found.agrees
    assert found.as_stable
