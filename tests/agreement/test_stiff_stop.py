"""A mass that strikes a stiff stop, against its exact piecewise linear motion."""

import itertools

import numpy as np
import pytest
from scipy.optimize import root

from hbm.curves.drive_search import Sought
from hbm.options import CurveOptions
from hbm.solve import detached, frequency_response
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip_mechanics.static import static_equilibrium
from struck import DAMPING, DRIVE, GAP, MASS, STIFFNESS, Struck
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit

UNSTABLE = {
    6e4: [(3.13, (39.6, 0.0738, 0.83)), (3.55, (37.3, 0.0663, 0.59))],
    2e5: [(3.08, (40.8, 0.0436, 0.81)), (3.55, (38.8, 0.0406, 0.61))],
}
"""phases of first touch of unstable motions, and about what they are then"""


@pytest.mark.parametrize(
    "stop",
    [
        pytest.param(2e4, marks=pytest.mark.long),
        6e4,
        pytest.param(1e5, marks=pytest.mark.long),
        pytest.param(2e5, marks=pytest.mark.long),
    ],
)
def test_the_curve_of_a_mass_that_strikes_a_stiff_stop_is_whole(stop: float) -> None:
    scene = load_scene("gap", [f"drive.x={DRIVE}", f"element.stop.stiffness={stop}"])
    problem = problem_of(scene)
    options = CurveOptions(2.0 * np.pi * 4.5, 2.0 * np.pi * 8.0)
    struck = Struck(stop)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    events = [each.event for each in found if each.event]
    assert events.count("fold") == 2
    assert "restart" not in events
    assert len(found) < 130  # 642 where Newton's iteration crept from sample to sample
    upper = next(each for each in found if each.event == "fold")
    exact, _ = struck.fold(upper)
    assert upper.frequency == pytest.approx(exact, rel=2e-5)
    assert abs(upper.frequency - exact) <= upper.parameter_error
    for each in found:
        size = np.hypot(*each.coefficients[1:3, 0])
        if not each.event and size > 1.02 * GAP:
            _, omega, share, _ = struck.at(each)
            exactly = struck.multiplier(omega, share * 2.0 * np.pi / omega)
            largest = float(np.abs(each.multipliers).max())
            assert largest == pytest.approx(exactly, rel=5e-3)  # measured 2.7e-3
            assert each.unstable == (exactly > 1.0)


@pytest.mark.parametrize(
    ("stop", "drive", "tolerance", "most"),
    [
        (2e3, 0.1, 1e-4, 31),  # errors change with the place of touches
        (1e4, 0.05, 1e-4, 511),
        (6e4, 0.1, 1e-4, 255),
        (6e4, 0.1, 1e-3, 63),  # the fold of first touch, in short steps
        (2e5, 0.1, 1e-4, 255),
    ],
)
def test_amplitudes_of_folds_err_by_no_more_than_is_told(
    stop: float, drive: float, tolerance: float, most: int
) -> None:
    # with 255 harmonics and more up to a hundredth was told, with few up to a twelfth
    scene = load_scene("gap", [f"drive.x={drive}", f"element.stop.stiffness={stop}"])
    problem = problem_of(scene)
    options = CurveOptions(
        2.0 * np.pi * 4.5, 2.0 * np.pi * 8.0, error=tolerance, stability=False
    )

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    folds = [each for each in found if each.event == "fold"]
    assert max(each.harmonics for each in folds) == most
    for each in folds:
        exact, amplitude = Struck(stop, drive).fold(each)
        size = float(each.amplitudes(problem.probes.rows).max())
        assert abs(each.frequency - exact) <= each.parameter_error
        assert abs(size / amplitude - 1.0) <= each.error < 2e-3


@pytest.mark.long
@pytest.mark.parametrize(
    ("stop", "range_", "error"),
    [(6e4, (4.5, 8.0), 1e-2), (1e7, (4.0, 8.5), 1e-3), (1e7, (4.0, 11.0), 1e-3)],
)
def test_each_response_is_told_once_where_few_harmonics_lead_to_and_fro(
    stop: float, range_: tuple[float, float], error: float
) -> None:
    # the first went back along itself where it grazes; with a stop ten thousand times
    # as stiff as the spring ripples turned the second round, and ended the third
    drive, place = 0.1, 40.0
    scene = load_scene("gap", [f"drive.x={drive}", f"element.stop.stiffness={stop}"])
    problem = problem_of(scene)
    start, end = (2.0 * np.pi * hertz for hertz in range_)
    options = CurveOptions(start, end, error=error, stability=False)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    there = [
        min(pair, key=lambda each: abs(each.frequency - place))
        for pair in itertools.pairwise(found)
        if not pair[1].event
        and (pair[0].frequency < place) is not (pair[1].frequency < place)
    ]
    struck = Struck(stop, drive)
    loud, unstable, quiet = (np.hypot(*each.coefficients[1:3, 0]) for each in there)
    assert found[-1].frequency == options.end
    assert [each.event for each in found].count("restart") == 1
    for each, size in zip(there, (loud, unstable), strict=False):
        phase, *unknown = struck.at(each)
        exact = struck.amplitude(np.array(unknown), phase)
        assert abs(size / exact - 1.0) <= each.error < error
    omega = there[-1].frequency
    exact = drive / abs(STIFFNESS - MASS * omega**2 + 1j * DAMPING * omega)
    assert quiet == pytest.approx(exact, rel=1e-9)
    assert loud > 1.02 * unstable > 3.0 * quiet


@pytest.mark.long
def test_unstable_motions_are_found_that_begin_where_a_stop_is_grazed() -> None:
    # ten thousand times as stiff as the spring; the curve comes there at rest
    scene = load_scene("gap", ["element.stop.stiffness=1e7"])
    problem, drive = problem_of(scene), 0.1
    options = CurveOptions(2.0 * np.pi * 7.0, 2.0 * np.pi * 4.0, stability=False)
    square = STIFFNESS - 0.5 * DAMPING**2
    grazed = np.sqrt(square + np.sqrt(square**2 - STIFFNESS**2 + (drive / GAP) ** 2))

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    (fold,) = (each for each in found if each.event == "fold")
    behind = list(
        itertools.takewhile(lambda each: not each.event, found[found.index(fold) + 2 :])
    )
    assert fold.frequency == pytest.approx(grazed, rel=1e-6)
    assert abs(fold.frequency - grazed) <= fold.parameter_error
    assert behind[-1].frequency == options.start
    for each in behind[::4]:
        phase, *unknown = Struck(1e7, drive).at(each)
        exact = Struck(1e7, drive).amplitude(np.array(unknown), phase)
        size = float(np.hypot(*each.coefficients[1:3, 0]))
        assert abs(size / exact - 1.0) <= max(each.error, 1e-6)


def test_what_folds_far_beyond_a_range_is_found_by_the_drive() -> None:
    # it hangs together with the quiet motion where the stop is grazed, at 5.5 Hz
    stop, place, drive = 4e4, 7.1, 0.1
    problem = problem_of(load_scene("gap", [f"element.stop.stiffness={stop}"]))
    rest = static_equilibrium(problem)
    low, high = (2.0 * np.pi * (place + shift) for shift in (-0.05, 0.05))
    options = CurveOptions(low, high, stability=False)

    quiet = list(frequency_response(problem, rest, options))
    found = [
        each
        for each in detached(problem, rest, options, quiet, frequencies=1)
        if not isinstance(each, Sought)
    ]

    loud = [each for each in found if each.frequency == low]
    assert max(np.hypot(*each.coefficients[1:3, 0]) for each in quiet) < GAP
    assert found[0].event == "detached"
    assert loud
    for each in found:
        phase, *unknown = Struck(stop, drive).at(each)
        exact = Struck(stop, drive).amplitude(np.array(unknown), phase)
        size = float(np.hypot(*each.coefficients[1:3, 0]))
        assert abs(size / exact - 1.0) <= each.error < options.error


@pytest.mark.parametrize("ends", [(4.6, 5.0), (5.0, 4.6)])
def test_stability_of_brief_touches_is_known_as_exactly_as_it_is_told(
    ends: tuple[float, float],
) -> None:
    # a thousand times as stiff as the spring: it touches for a seventieth of a period
    struck = Struck(1e6)
    scene = load_scene("gap", [f"drive.x={DRIVE}", "element.stop.stiffness=1e6"])
    problem = problem_of(scene)
    options = CurveOptions(2.0 * np.pi * ends[0], 2.0 * np.pi * ends[1])

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    doublings = [each for each in found if each.event == "period doubling"]
    assert len(doublings) == 2
    for each in doublings:
        exact = struck.doubling(each)
        assert abs(each.frequency - exact) <= each.parameter_error < 2e-4 * exact
    touching = [each for each in found if each.normal_largest[0] > 0.0]
    for each in touching:
        if not each.event:
            _, omega, share, _ = struck.at(each)
            exactly = struck.multiplier(omega, share * 2.0 * np.pi / omega)
            assert np.abs(each.multipliers).max() == pytest.approx(exactly, rel=2e-3)


@pytest.mark.parametrize("hertz", [5.05, 5.3])
@pytest.mark.parametrize("stop", [1e6, 2.5e7])
def test_a_curve_begins_where_a_stiff_stop_is_struck(stop: float, hertz: float) -> None:
    # a drive that grows meets the fold of first touch, a stop that stiffens does not
    scene = load_scene("gap", [f"element.stop.stiffness={stop}"])
    problem, turn = problem_of(scene), 2.0 * np.pi * hertz
    options = CurveOptions(turn, 1.001 * turn, events=False, stability=False)
    struck = Struck(stop, drive=0.1)

    first = next(
        iter(frequency_response(problem, static_equilibrium(problem), options))
    )

    phase, (_, _, speed) = struck.near(first)
    exactly, _, _, impact = struck.at(first)
    assert first.frequency == turn
    assert phase == pytest.approx(exactly, rel=1e-3)
    assert speed == pytest.approx(impact, rel=0.02)


@pytest.mark.parametrize(("stop", "steps"), [(6e4, 1024), (2e5, 2048)])
def test_shooting_knows_the_multipliers_of_a_mass_that_strikes(
    stop: float, steps: int
) -> None:
    scene = load_scene("gap", [f"drive.x={DRIVE}", f"element.stop.stiffness={stop}"])
    problem = problem_of(scene)
    struck, options = Struck(stop), ShootingOptions(steps=steps, most=2 * steps)

    for phase, guess in UNSTABLE[stop]:
        exact = root(struck.missed, guess, args=(phase,), tol=1e-13).x
        assert np.abs(struck.missed(exact, phase)).max() < 1e-10
        omega, share, _ = exact
        expected = struck.multiplier(omega, share * 2.0 * np.pi / omega)

        orbit = periodic_orbit(
            problem, omega, start=struck.start(exact, phase), options=options
        )

        assert expected > 1.0
        # tangents at whole steps made -20 % to +11 % of it
        assert np.abs(orbit.multipliers).max() == pytest.approx(expected, rel=0.02)
