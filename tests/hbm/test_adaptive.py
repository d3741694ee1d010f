"""Resolution by tolerance: its steps up and down."""

import math
from typing import Any

import numpy as np
import pytest

import hbm.resolution.resolution
from hbm.balance.refined import PATIENT as PERSEVERING
from hbm.balance.refined import Refined
from hbm.continuation.corrected import correct_at
from hbm.continuation.step_control import StepControl
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.resolution.resolution_steps import PATIENT, SHORT, WAIT
from hbm.solve import frequency_response
from honesty import block
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem

TURN = 2.0 * np.pi
CONTROL = StepControl(tolerance=1e-8)
FREQUENCY = 11.0


def resolution_of(problem: Problem) -> PathResolution:
    rest = static_equilibrium(problem)
    path = along_frequency(problem, rest, FREQUENCY, 2.0 * FREQUENCY)
    return PathResolution(path, problem.probes.rows)


def adaptive(
    problem: Problem, *, tolerance: float | None, start: FourierBasis, most: int = 255
) -> tuple[AdaptiveBalance, Array]:
    """Return a system and a guess at rest."""
    system = AdaptiveBalance(
        resolution_of(problem), start, tolerance=tolerance, most=most
    )
    guess = np.zeros(system.size)
    guess[-1] = FREQUENCY
    return system, guess


COARSE = FourierBasis(1, 32)


@pytest.mark.parametrize("tolerance", [3e-2, 3e-3, 3e-4, 3e-5])
def test_a_point_settles_at_the_error_that_is_asked_for(tolerance: float) -> None:
    system, guess = adaptive(block(), tolerance=tolerance, start=COARSE)

    found = correct_at(system, guess, CONTROL, system)

    assert system.estimate is not None
    assert system.estimate.error <= tolerance
    point, fourier, error = system.report.kept(found.point)
    assert error == system.estimate.error
    assert fourier.harmonics == 2 * system.fourier.harmonics + 1
    assert fourier.samples == 2 * system.fourier.samples
    assert point.size == system.size


def test_smaller_tolerances_take_more_harmonics_and_samples() -> None:
    taken = []
    for tolerance in (3e-2, 3e-3, 3e-4, 3e-5):
        system, guess = adaptive(block(), tolerance=tolerance, start=COARSE)
        found = correct_at(system, guess, CONTROL, system)
        _, fourier, _ = system.report.kept(found.point)
        taken.append((fourier.harmonics, fourier.samples))

    harmonics, samples = np.array(taken).T
    assert np.all(np.diff(harmonics) >= 0)
    assert np.all(np.diff(samples) >= 0)
    assert harmonics[-1] >= 8 * harmonics[0]


def test_the_most_harmonics_are_not_exceeded_and_the_error_says_so() -> None:
    system, guess = adaptive(block(), tolerance=1e-6, start=COARSE, most=7)

    found = correct_at(system, guess, CONTROL, system)

    _, fourier, error = system.report.kept(found.point)
    assert fourier.harmonics == 2 * 7 + 1
    assert error > 1e-6


def test_finer_points_are_sought_with_patience_once_there_are_no_more_harmonics(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    refined = vars(hbm.resolution.resolution)["refined"]

    def lost(*given: Any) -> Refined:
        made: Refined = refined(*given)
        return made if given[-1] == PERSEVERING else made._replace(left=math.inf)

    monkeypatch.setattr("hbm.resolution.resolution.refined", lost)
    few, fixed = (
        adaptive(block(), tolerance=tolerance, start=COARSE, most=7)
        for tolerance in (1e-6, None)
    )
    for system, guess in (few, fixed):
        found = correct_at(system, guess, CONTROL, system)
        assert system.report.kept(found.point)[2] == math.inf
        system.persevere()

    assert few[0].estimate is not None
    assert 1e-6 < few[0].estimate.error < 1.0
    assert fixed[0].report.kept(found.point)[2] == math.inf


@pytest.mark.parametrize(("harmonics", "samples"), [(3, 64), (5, 96), (9, 128)])
def test_fixed_harmonics_stay_and_have_the_error_before_the_correction(
    harmonics: int, samples: int
) -> None:
    start, finest = FourierBasis(harmonics, samples), FourierBasis(127, 4096)
    system, guess = adaptive(block(), tolerance=None, start=start)
    reference, finer = adaptive(block(), tolerance=None, start=finest)

    found = correct_at(system, guess, CONTROL, system)
    exact = correct_at(reference, finer, CONTROL, reference)

    point, fourier, error = system.report.kept(found.point)
    assert fourier == start
    np.testing.assert_array_equal(point, found.point)
    (known,), (size,) = resolution_of(block()).amplitudes([point, exact.point])
    true = abs(known / size - 1.0)
    # a bound, and no idle one: measured 6.3, 6.2 and 1.6 times as large
    assert true <= error <= 10.0 * true
    # nothing is corrected: the error is larger than with a tolerance
    assert system.estimate is not None
    assert error > system.estimate.error


def test_a_settled_point_solves_the_system_of_its_resolution() -> None:
    system, guess = adaptive(block(), tolerance=1e-3, start=COARSE)

    found = correct_at(system, guess, CONTROL, system)

    assert np.abs(found.residual).max() <= CONTROL.tolerance
    again, _ = system(found.point)
    np.testing.assert_array_equal(again, found.residual)


def test_points_that_fail_go_back_to_what_worked_and_then_to_more() -> None:
    system, guess = adaptive(block(), tolerance=3e-2, start=FourierBasis(31, 1024))
    correct_at(system, guess, CONTROL, system)
    lower = system.fourier

    system.retreat(1)
    first = system.fourier
    system.retreat(PATIENT)
    second = system.fourier
    system.retreat(10 * PATIENT)
    third = system.fourier

    # Where much was to spare less was tried; it failed, and is not tried for a while.
    assert lower.harmonics < first.harmonics == 31
    assert (second.harmonics, second.samples) == (63, 2048)
    assert (third.harmonics, third.samples) == (255, 16384)
    # If what had worked fails too, less is tried at the next point.
    system.retreat(1)
    system.keep()
    assert system.fourier == lower
    system.retreat(1)
    for _ in range(WAIT - 1):
        system.keep()
        assert system.fourier == first
    system.keep()
    assert system.fourier == lower


def test_what_is_raised_is_kept_until_a_curve_begins_anew() -> None:
    system, guess = adaptive(
        block(), tolerance=3e-2, start=FourierBasis(7, 128), most=31
    )
    correct_at(system, guess, CONTROL, system)
    lower = system.fourier
    system.retreat(1)

    assert system.raise_floor()
    assert (system.fourier.harmonics, system.fourier.samples) == (15, 256)
    correct_at(system, guess, CONTROL, system)
    for _ in range(2 * WAIT):
        system.keep()
    assert (system.fourier.harmonics, system.fourier.samples) == (15, 256)

    assert system.raise_floor()
    assert (system.fourier.harmonics, system.fourier.samples) == (31, 512)
    assert not system.raise_floor()  # these are the most

    system.restart(3)
    correct_at(system, guess, CONTROL, system)
    system.keep()
    assert system.fourier.harmonics <= lower.harmonics


def test_fixed_harmonics_are_not_raised() -> None:
    system, guess = adaptive(block(), tolerance=None, start=COARSE)
    correct_at(system, guess, CONTROL, system)

    assert not system.raise_floor()
    assert system.fourier == COARSE


def test_less_is_not_tried_after_a_short_step() -> None:
    system, guess = adaptive(block(), tolerance=3e-2, start=FourierBasis(31, 1024))
    correct_at(system, guess, CONTROL, system)
    lower = system.fourier
    system.retreat(1)

    for _ in range(WAIT):
        system.keep(0.5 * SHORT)
    assert (system.fourier.harmonics, system.fourier.samples) == (31, 1024)

    system.keep(SHORT)
    assert system.fourier == lower


def test_harmonics_and_samples_drop_again_where_slip_ends() -> None:
    problem = rig_problem(model="A")
    options = CurveOptions(TURN * 125.0, TURN * 145.0)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    sticks = [_sticks(response) for response in curve]
    assert sticks[0]
    assert sticks[-1]
    assert not all(sticks)
    harmonics = np.array([response.harmonics for response in curve])
    assert harmonics[[0, -1]].max() <= 3
    assert harmonics.max() >= 31
    assert harmonics[-1] == harmonics[0]
    assert curve[-1].samples == curve[0].samples


def _sticks(response: PeriodicResponse) -> bool:
    """Return whether no friction is saturated: the motion is that of a dashpot."""
    overtones = np.abs(response.coefficients[3:]).max(initial=0.0)
    return bool(overtones < 1e-9 * np.abs(response.coefficients[1:3]).max())


@pytest.mark.parametrize("error", [1e-2, 1e-3, 1e-4])
def test_no_point_of_a_curve_errs_by_more_than_its_tolerance(error: float) -> None:
    problem = block()
    options = CurveOptions(6.0, 20.0, error=error)

    curve = frequency_response(problem, static_equilibrium(problem), options)

    assert max(response.error for response in curve) <= error
