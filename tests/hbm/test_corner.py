"""Corners of a curve: turned round where its halves make an acute angle."""

import itertools
from dataclasses import replace

import numpy as np
import pytest

from hbm.continuation.continuation import trace
from hbm.continuation.corner import round_corner
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.step_control import StepControl
from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.arrays import Array
from microslip_mechanics.static import static_equilibrium
from systems import Dense

TURN = 2.0 * np.pi

CONTROL = StepControl(initial=0.05, largest=0.1)


def bent(slope: float, point: Array) -> tuple[Array, Dense]:
    """Return λ − x before x = 0, and λ + slope x behind."""
    x, parameter = point
    factor = -1.0 if x < 0.0 else slope
    return np.array([parameter + factor * x]), Dense([[factor, 1.0]])


def unit(point: Array) -> Array:
    return np.ones_like(point)


def traced(slope: float) -> list[Correction]:
    """Return the points of the curve up to where plain continuation ends."""
    start = np.array([-1.0, -1.0])
    points = trace(
        lambda point: bent(slope, point), start, 1.0, metric=unit, control=CONTROL
    )
    found: list[Correction] = []
    try:
        for each in points:
            found.append(each)  # noqa: PERF402  (what is there must be kept)
    except ContinuationError:
        return found
    raise AssertionError("plain continuation gets round the corner")


@pytest.mark.parametrize("length", [1e-4, 1e-7])
def test_a_corner_is_turned_that_lies_next_to_the_beginning(length: float) -> None:
    # as of a piece that is taken up just before it, with more harmonics
    way = traced(3.0)[-3:]
    begins = np.array([-length, -length])
    way = [
        replace(each, point=share * begins)
        for each, share in zip(way, (1, 0.5, 0.1), strict=True)
    ]

    turned = round_corner(lambda point: bent(3.0, point), way, unit, 1e-12)

    assert turned is not None
    point, direction, folds = turned
    assert point[0] > 0.0
    assert point[1] == pytest.approx(-3.0 * point[0])
    assert direction[-1] < 0.0
    assert folds


def test_a_corner_does_not_lead_to_where_the_curve_has_been() -> None:
    way, asked = traced(3.0), []

    def has_been_at(point: Array, scale: Array) -> bool:
        asked.append(point)
        assert np.array_equal(scale, unit(point))
        return True

    turned = round_corner(lambda point: bent(3.0, point), way, unit, 1e-12, has_been_at)

    assert turned is None
    assert all(point[1] == pytest.approx(-3.0 * point[0]) for point in asked)
    assert asked


@pytest.mark.parametrize("slope", [1.5, 3.0, 10.0])
def test_a_sharp_corner_is_turned_onto_its_second_half(slope: float) -> None:
    way = traced(slope)
    assert way[-1].point == pytest.approx([0.0, 0.0], abs=1e-4)

    turned = round_corner(lambda point: bent(slope, point), way, unit, 1e-12)

    assert turned is not None
    point, direction, folds = turned
    assert folds
    assert point[0] > 0.0
    assert point[1] == pytest.approx(-slope * point[0], rel=1e-9)
    expected = np.array([1.0, -slope]) / np.hypot(1.0, slope)
    np.testing.assert_allclose(direction, expected, rtol=1e-9)


def diagonal(along: Array) -> list[Correction]:
    """Return two points of x = p, up to the origin, with a tangent."""
    return [
        Correction(
            np.array([place, place]),
            np.zeros(1),
            Dense([[-1.0, 1.0]]),
            Outcome.CONVERGED,
            (0.0,),
            along,
        )
        for place in (-0.1, -1e-6)
    ]


def test_a_corner_behind_which_the_parameter_goes_on_is_no_fold() -> None:
    def roof(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        slope = -10.0 if parameter < 0.0 else 10.0
        return np.array([x + slope * parameter]), Dense([[1.0, slope]])

    along = np.array([10.0, 1.0]) / np.hypot(10.0, 1.0)
    way = [
        Correction(
            np.array([10.0 * place, place]),
            np.zeros(1),
            roof(np.array([10.0 * place, place]))[1],
            Outcome.CONVERGED,
            (0.0,),
            along,
        )
        for place in (-0.1, -1e-9)
    ]

    turned = round_corner(roof, way, unit, 1e-12)

    assert turned is not None
    assert turned.point[0] < 0.0 < turned.point[1]
    assert not turned.folds


def test_there_is_no_corner_where_the_curve_ends() -> None:
    """A curve that stops has a tangent of one side only."""

    def ending(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        jump = 0.0 if x < 0.0 else 1.0
        return np.array([parameter - x + jump]), Dense([[-1.0, 1.0]])

    way = diagonal(np.array([1.0, 1.0]) / np.sqrt(2.0))
    assert round_corner(ending, way, unit, 1e-12) is None


def test_the_way_back_is_no_corner_even_if_the_last_tangent_is_off() -> None:
    def straight(point: Array) -> tuple[Array, Dense]:
        x, parameter = point
        tilted = 1.2 if x > -1e-5 else 1.0
        return np.array([parameter - x]), Dense([[-1.0, tilted]])

    way = diagonal(np.array([1.2, 1.0]) / np.hypot(1.2, 1.0))
    assert round_corner(straight, way, unit, 1e-12) is None


@pytest.mark.long
@pytest.mark.slow
def test_chain_of_sliders_and_a_stop_is_traced_from_end_to_end() -> None:
    """NLvib's example 07: three masses, two sliders, two cubic springs, a stop."""
    scene = load_scene("chain")
    problem = problem_of(scene)
    options = CurveOptions(
        0.5, 2.0, harmonics=7, samples=1024, stability=False, errors=False
    )

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    assert found[0].frequency == 0.5
    assert found[-1].frequency == 2.0
    events = [each.event for each in found]
    assert "restart" not in events
    assert events.count("fold") >= 3


def test_a_direction_in_which_nothing_is_found_is_tried_once() -> None:
    """Behind the end the derivative has one direction, wherever it is taken."""
    calls = 0

    def ends(point: Array) -> tuple[Array, Dense]:
        nonlocal calls
        calls += 1
        x, parameter = point
        if x < 0.0:
            return np.array([parameter - x]), Dense([[-1.0, 1.0]])
        return np.array([1.0 + x**2]), Dense([[3.0, 1.0]])

    way = diagonal(np.array([1.0, 1.0]) / np.sqrt(2.0))

    assert round_corner(ends, way, unit, 1e-12) is None
    # measured 18, and 42 where every derivative's direction is tried
    assert calls <= 25


@pytest.mark.parametrize(
    "tolerance",
    [*(pytest.param(each, marks=pytest.mark.long) for each in (1e-2, 8e-3)), 2e-3],
)
def test_a_beam_that_rubs_at_its_tip_is_traced_without_turning_back(
    tolerance: float,
) -> None:
    """Where its slider begins to slip the tangents of both sides meet head on."""
    scene = load_scene("friction-beam")
    problem = problem_of(scene)
    curve = scene.curve
    options = CurveOptions(
        TURN * curve.lowest,
        TURN * curve.highest,
        error=tolerance,
        stability=False,
    )

    traced = frequency_response(problem, static_equilibrium(problem), options)
    points = list(itertools.islice(traced, 400))
    found = np.array([each.frequency for each in points])

    assert found.size < 300  # measured 140; it went to and fro without end
    assert found[-1] == TURN * curve.highest
    # Neither thrown back at a corner, as one tolerance was, nor folded where harmonics
    # hardly do; where their number changes a point moves by 4e-5.
    back = np.maximum.accumulate(found) / found - 1.0
    assert back.max() < 1e-4
    # Short steps round the corner, not many harmonics: they were 511.
    assert max(each.harmonics for each in points) <= 127
    assert {each.event for each in points} == {"", "peak"}


@pytest.mark.long
def test_a_beam_with_more_corners_has_its_whole_curve() -> None:
    """Fewer harmonics behind short steps threw it back, and it did not go on there."""
    scene = load_scene("friction-beam", ["element.friction.load=5"])
    problem, curve = problem_of(scene), scene.curve
    ends = TURN * curve.lowest, TURN * curve.highest
    options = CurveOptions(*ends, error=1e-2, stability=False, events=False)

    traced = frequency_response(problem, static_equilibrium(problem), options)
    found = np.array([each.frequency for each in itertools.islice(traced, 600)])

    assert (found.min(), found.max()) == ends
    # no step is much longer than a quarter of a tenth of the range
    assert np.diff(np.sort(found)).max() < 0.03 * (ends[1] - ends[0])
    assert found.size < 400  # measured 221


@pytest.mark.parametrize(
    ("name", "number"),
    # the beam's curve goes to and fro within the tolerance, which is no fold
    [pytest.param("chain", 4, marks=pytest.mark.long), ("friction-beam", 0)],
)
def test_folds_at_corners_are_told(name: str, number: int) -> None:
    scene = load_scene(name)
    problem, span = problem_of(scene), scene.curve
    options = CurveOptions(
        2.0 * np.pi * span.lowest,
        2.0 * np.pi * span.highest,
        error=span.tolerance,
        harmonics=span.harmonics,
        samples=span.samples,
        stability=False,
    )

    points = list(frequency_response(problem, static_equilibrium(problem), options))

    folds = [place for place, each in enumerate(points) if each.event == "fold"]
    assert len(folds) == number
    for place in folds:
        before, fold, after = (points[place + side].frequency for side in (-1, 0, 1))
        assert (fold - before) * (after - fold) <= 0.0
