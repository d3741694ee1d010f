"""Friction smoother than it is: when that is taken, and what it costs."""

import math
from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from typing import Any

import numpy as np
import pytest
from scipy.optimize import brentq

from hbm.balance.refined import Patience, Refined
from hbm.continuation.corrected import correct_at
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.step_control import StepControl
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.path import along_frequency
from hbm.paths.path_resolution import PathResolution
from hbm.paths.smoothness import FALL, smoothest
from hbm.resolution.adaptive import AdaptiveBalance
from hbm.resolution.estimate import Estimate
from hbm.resolution.resolution import Resolution
from hbm.resolution.resolution_choice import SHARPER
from hbm.resolution.resolution_steps import WAIT
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from small_problems import sliding_block
from systems import Dense

TURN = 2.0 * np.pi
STIFFNESS, LIMIT, DRIVE = 300.0, 0.3, 1.5
CONTROL = StepControl(tolerance=1e-8)


def dry(threshold: float, **more: float) -> Problem:
    """Return a mass of 1 kg on a spring, and on friction of 0.3 N."""
    return sliding_block(
        mass=1.0,
        stiffness=STIFFNESS,
        drive=DRIVE,
        load=1.0,
        dynamic=LIMIT,
        threshold=threshold,
        **more,
    )


def den_hartog(frequency: Array) -> Array:
    """Return the largest deflection under dry friction, without stops [m].

    J. P. Den Hartog, "Forced vibrations with combined Coulomb and viscous friction",
    Trans. ASME 53 (1931), APM-53-9, pp. 107–115.
    """
    ratio = frequency / np.sqrt(STIFFNESS)
    turn = np.pi / ratio
    loss = np.sin(turn) / (ratio * (1.0 + np.cos(turn)))
    size = (1.0 / (1.0 - ratio**2)) ** 2 - (LIMIT / DRIVE * loss) ** 2
    deflection: Array = DRIVE / STIFFNESS * np.sqrt(size)
    return deflection


@pytest.mark.parametrize("threshold", [1e-6, 1e-9, 1e-12])
def test_friction_that_turns_at_once_has_den_hartogs_amplitude(
    threshold: float,
) -> None:
    problem = dry(threshold)
    options = CurveOptions(12.0, 16.0, error=1e-3)
    phase = np.linspace(0.0, TURN, 4000)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    frequency = np.array([each.frequency for each in curve])
    largest = np.array([np.abs(each.at(phase)[0]).max() for each in curve])
    np.testing.assert_allclose(largest, den_hartog(frequency), rtol=2e-3)
    assert max(each.error for each in curve) <= 1e-3
    assert len(curve) < 60


def start_of(problem: Problem, options: CurveOptions) -> float:
    """Return the threshold velocity with which a curve begins [m/s]."""
    rest = static_equilibrium(problem)
    path = along_frequency(problem, rest, options.start, options.end)
    return smoothest(path, options)


RIG = CurveOptions(TURN * 125.0, TURN * 145.0)


def test_the_rig_keeps_its_threshold_and_a_tiny_one_does_not() -> None:
    tiny = rig_problem(model="A", friction__threshold_velocity=1e-7)

    smooth = start_of(tiny, RIG)

    assert start_of(rig_problem(model="A"), RIG) == 0.0
    assert 1e-5 < smooth < 1e-3
    assert start_of(tiny, replace(RIG, error=1e-2)) == pytest.approx(10.0 * smooth)


def test_friction_is_as_it_is_with_fixed_harmonics_or_without_any() -> None:
    tiny = rig_problem(model="A", friction__threshold_velocity=1e-7)
    none = rig_problem(model="A", friction__law="none")

    assert start_of(tiny, replace(RIG, harmonics=15)) == 0.0
    assert start_of(none, RIG) == 0.0


def test_the_fall_of_friction_is_not_smoothed_over() -> None:
    falls = rig_problem(
        model="A",
        friction__law="gkf",
        friction__threshold_velocity=1e-9,
        friction__stribeck_velocity=1e-5,
    )

    assert start_of(falls, RIG) == pytest.approx(FALL * 1e-5)


FREQUENCY = 15.0
"""[rad/s], at which the mass slides all the time"""
SMOOTHEST = 1.0
"""threshold velocity [m/s], faster than anything slides"""


def resolution() -> PathResolution:
    problem = dry(1e-9)
    path = along_frequency(problem, static_equilibrium(problem), FREQUENCY, 22.0)
    return PathResolution(path, problem.probes.rows)


def guess(size: int) -> Array:
    point = np.zeros(size)
    point[-1] = FREQUENCY
    return point


def test_what_is_too_smooth_is_sharpened_and_eased_again() -> None:
    start = FourierBasis(7, 128, SMOOTHEST)
    system = AdaptiveBalance(resolution(), start, tolerance=3e-3)

    found = correct_at(system, guess(system.size), CONTROL, system)

    assert found.outcome is Outcome.CONVERGED
    assert system.estimate is not None
    assert system.estimate.error <= 3e-3
    assert system.settled.threshold < SMOOTHEST
    steps = np.log(SMOOTHEST / system.settled.threshold) / np.log(SHARPER)
    assert steps == pytest.approx(round(steps))

    system.restart(7)

    assert system.fourier.threshold == SMOOTHEST


def test_what_is_raised_keeps_friction_as_sharp_as_it_was() -> None:
    start = FourierBasis(7, 128, SMOOTHEST)
    system = AdaptiveBalance(resolution(), start, tolerance=3e-3)
    found = correct_at(system, guess(system.size), CONTROL, system)
    sharp = system.settled.threshold

    assert system.raise_floor()
    system.fourier = replace(system.fourier, threshold=sharp / SHARPER**3)
    correct_at(system, found.point, CONTROL, system)
    for _ in range(2 * WAIT):
        system.keep()

    assert system.fourier.threshold <= sharp < SMOOTHEST


class Blunt(Resolution):
    """Solvable with friction no sharper than a threshold velocity; all that errs."""

    rank = 1

    def __init__(self, sharpest: float) -> None:
        self.sharpest, self.coarsest, self.sampling = sharpest, math.inf, 0.0
        self.needed = 1
        """harmonics below which one is missed"""
        self.tried: list[FourierBasis] = []

    def at(self, fourier: FourierBasis) -> Any:
        self.tried.append(fourier)
        sharp = fourier.threshold < self.sharpest
        solvable = not sharp and fourier.samples <= self.coarsest

        def system(point: Array) -> tuple[Array, Dense]:
            rows = np.eye(point.size - 1, point.size)
            return point[:-1] if solvable else np.ones(point.size - 1), Dense(rows)

        return system

    def amplitudes(self, points: Sequence[Array]) -> Array:
        return np.array([point[:1] for point in points])

    def estimate(
        self,
        correction: Correction,
        fourier: FourierBasis,
        _: Array,
        tolerance: float = 0.0,
        patience: Patience | None = None,
    ) -> Estimate:
        assert patience is None
        assert tolerance > 0.0
        smoothing = 0.1 * fourier.threshold
        point, slope = correction.point, correction.linearised
        truncation = 0.5 if fourier.harmonics < self.needed else 0.0
        errors = 0.0, truncation, self.sampling, smoothing, 0.0, 0.0
        rest = correction.residual
        made = Refined(rest, point, point, 0.0, 0.0, rest, slope, point)
        return Estimate(*errors, fourier, made, point, None, np.zeros((5, 1)))


def test_friction_that_cannot_be_sharper_stays_and_the_error_says_so() -> None:
    made = Blunt(sharpest=0.05)
    system = AdaptiveBalance(made, FourierBasis(3, 128, 1.0), tolerance=1e-3, most=3)

    found = correct_at(system, guess(system.size), CONTROL, system)

    assert found.outcome is Outcome.CONVERGED
    assert system.estimate is not None
    assert system.estimate.error == pytest.approx(0.1 * SHARPER**-2)
    assert system.fourier.threshold == SHARPER**-2
    assert made.tried[-1].threshold == SHARPER**-3

    system.keep()
    made.tried.clear()
    again = correct_at(system, found.point, CONTROL, system)

    assert again.outcome is Outcome.CONVERGED
    tried = {each.threshold for each in made.tried}
    assert tried <= {SHARPER**-2}  # it is not sharper at every point

    made.sharpest = 0.0
    for _ in range(WAIT + 1):
        correct_at(system, found.point, CONTROL, system)
        system.keep()

    assert system.estimate.error <= 1e-3  # but it is again after some


def test_friction_is_sharpened_once_harmonics_are_enough() -> None:
    made = Blunt(sharpest=0.0)
    made.needed = 7
    system = AdaptiveBalance(made, FourierBasis(3, 128, 1.0), tolerance=1e-2)

    correct_at(system, guess(system.size), CONTROL, system)

    assert system.settled.threshold < 0.1
    tried = [(each.harmonics, each.threshold) for each in made.tried]
    assert [each for each, _ in groupby(tried)][:3] == [(3, 1.0), (7, 1.0), (7, 0.25)]


def stick_slip(stiffness: float, drive: float, limit: float, frequency: float) -> float:
    """Return the amplitude of 1 kg that slips once per half period, then sticks [m].

    It starts as spring and drive exceed the limit, and stops at the other extreme: the
    amplitude at which that is as far away, from the motion in between in closed form.
    """
    own = np.sqrt(stiffness)
    forced = drive / (stiffness - frequency**2)

    def gained(amplitude: float) -> float:
        start = -np.arccos((limit - stiffness * amplitude) / drive)
        free = limit / stiffness - amplitude - forced * np.cos(start)
        swing = forced * frequency * np.sin(start) / own

        def velocity(time: Any) -> Any:
            driven = -forced * frequency * np.sin(frequency * time + start)
            return driven + own * (
                swing * np.cos(own * time) - free * np.sin(own * time)
            )

        times = np.linspace(1e-6, np.pi / frequency, 4000)
        last = int(np.flatnonzero(velocity(times) < 0.0)[0])
        stop = brentq(velocity, times[last - 1], times[last])
        reached = forced * np.cos(frequency * stop + start) - limit / stiffness
        reached += free * np.cos(own * stop) + swing * np.sin(own * stop)
        return float(reached) - amplitude

    return float(brentq(gained, 1e-7, (drive + limit) / stiffness * 0.99))


def test_a_first_point_just_above_the_slip_limit_is_found() -> None:
    stiffness, drive, limit, slow = 15000.0, 56.0, 50.0, 8.0 * TURN
    sizes = {"stiffness": stiffness, "drive": drive, "dynamic": limit}
    problem = sliding_block(mass=1.0, load=1.0, threshold=5e-5, **sizes)
    options = CurveOptions(slow, 1.001 * slow, error=1e-3)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    assert first.frequency == slow
    largest = np.abs(first.at(np.linspace(0.0, TURN, 4000))[0]).max()
    exact = stick_slip(stiffness, drive, limit, slow)
    true = abs(largest / exact - 1.0)
    assert true <= first.error
    assert true < 0.025


def test_what_fails_for_other_reasons_than_friction_is_not_accepted() -> None:
    made = Blunt(sharpest=0.0)
    made.coarsest, made.sampling = 128, 0.5
    system = AdaptiveBalance(made, FourierBasis(3, 128, 1e-9), tolerance=1e-3, most=3)

    with pytest.raises(ContinuationError):
        correct_at(system, guess(system.size), CONTROL, system)


def test_friction_that_could_be_sharper_with_more_harmonics_is_not_left() -> None:
    made = Blunt(sharpest=0.05)
    system = AdaptiveBalance(made, FourierBasis(3, 128, 1.0), tolerance=1e-3, most=7)

    with pytest.raises(ContinuationError):
        correct_at(system, guess(system.size), CONTROL, system)


@pytest.mark.parametrize("threshold", [0.1, 0.02, 0.004])
def test_smoothing_is_estimated_as_what_resolving_changes(threshold: float) -> None:
    made, amplitude = resolution(), []
    point, fourier = guess(256), FourierBasis(63, 1024, SMOOTHEST)
    for each in (SMOOTHEST, threshold, 0.1 * threshold, 1e-3 * threshold):
        fourier = replace(fourier, threshold=each)
        found = correct_at(made.at(fourier), point, CONTROL)
        point = found.point
        amplitude.append(made.amplitudes([point])[0, 0])
        if each == threshold:
            upright = np.zeros_like(point)
            upright[-1] = 1.0
            estimate = made.estimate(found, fourier, upright)

    change = abs(amplitude[1] - amplitude[-1]) / amplitude[-1]
    assert change <= 1.1 * estimate.smoothing <= 4.0 * change
