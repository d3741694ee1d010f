"""Swept sines both ways jump where harmonic balance folds, their rate taken out."""

import functools

import numpy as np
import pytest

from microslip.studies.jumps.folds import Fold, folds_of
from microslip.studies.jumps.jumps import Jump, extrapolated, jumps
from microslip.studies.verify.verify import StudyError
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import cubic_oscillator
from traced_curves import traced

TURN = 2.0 * np.pi
RATES = [2e-4, 1e-4, 5e-5, 2.5e-5, 1.25e-5]
"""of the sweeps [Hz/s]: the slowest passes three thousand periods"""
RELATIVE = (2.2e-5, 1.1e-5, 5.5e-6, 2.75e-6)


@functools.cache
def duffing() -> tuple[Problem, list[Fold]]:
    problem = cubic_oscillator(drive=0.3, damping=0.1)
    return problem, folds_of(problem, traced(problem, 0.8, 2.4), lead=0.1)


@functools.cache
def jumped() -> list[Jump]:
    problem, folds = duffing()
    return list(jumps(problem, folds, RATES))


def admitted(jump: Jump) -> float:
    """Return how far from its fold a jump may lie [Hz]: as the command admits."""
    return 3.0 * jump.fit_error + jump.step_error + 1e-4 * jump.fold.hertz


@pytest.mark.parametrize("exact", [0.28, 137.0])
def test_the_law_of_the_delay_is_taken_out_of_jumps(exact: float) -> None:
    rates = np.array([8.0, 4.0, 2.0, 1.0])
    made = exact + 3e-3 * rates ** (2.0 / 3.0) - 1e-3 * rates

    found, error = extrapolated(rates, made)

    assert found == pytest.approx(exact, abs=1e-12 * exact)
    assert error < 1e-11 * exact


def test_the_error_of_the_extrapolation_is_that_of_scattered_jumps() -> None:
    draw, rates = np.random.default_rng(3), np.array([16.0, 8.0, 4.0, 2.0, 1.0])
    law = 3e-3 * rates ** (2.0 / 3.0)

    made = [extrapolated(rates, law + draw.normal(0.0, 1e-4, 5)) for _ in range(400)]

    away, error = np.array(made).T
    # on the safe side: what the fastest sweep changes counts too
    assert 1.0 < np.sqrt(np.mean(error**2)) / away.std() < 2.5
    assert np.mean(np.abs(away) < 3.0 * error) > 0.9
    assert abs(away.mean()) < 3.0 * away.std() / 20.0


def test_one_fold_ends_sweeps_upwards_and_the_other_those_downwards() -> None:
    _, (first, second) = duffing()

    assert (first.upward, second.upward) == (True, False)
    assert first.hertz > second.hertz
    assert first.begin.frequency < first.response.frequency
    assert second.begin.frequency > second.response.frequency


@pytest.mark.long
@pytest.mark.parametrize("harmonics", [None, 63])
def test_folds_are_swept_whose_multipliers_pass_one_beside_them(
    harmonics: int | None,
) -> None:
    problem, low, high = FOLDED["slider"]
    curve = traced(problem, low, high, harmonics=harmonics)

    up, down = folds_of(problem, curve, lead=0.008)

    assert (up.upward, down.upward) == (True, False)
    for fold in (up, down):
        assert fold.begin.unstable == 0
        # from afar, whatever lies beside the fold
        away = abs(fold.begin.frequency / fold.response.frequency - 1.0)
        assert away > 0.004
    # the upper one is left on the branch of the larger motion
    assert np.hypot(*up.begin.coefficients[1:3, 0]) > up.height


def test_duffings_jumps_lie_on_the_folds_once_the_rate_is_taken_out() -> None:
    for jump in jumped():
        late = (jump.frequency - jump.fold.hertz) * (1.0 if jump.fold.upward else -1.0)
        # every sweep jumps late, a slower one less so
        assert np.all(late > 0.0)
        assert np.all(np.diff(late) < 0.0)
        # the delay of the slowest is what is taken out
        accepted = admitted(jump)
        assert accepted < 0.5 * late[-1]
        assert abs(jump.extrapolated - jump.fold.hertz) < accepted


def test_the_delay_goes_like_the_power_two_thirds_of_the_rate() -> None:
    for jump in jumped():
        late = np.abs(jump.frequency - jump.fold.hertz)[1:]
        power, _ = np.polyfit(np.log(jump.rates[1:]), np.log(late), 1)
        assert power == pytest.approx(2.0 / 3.0, abs=0.06)


@pytest.mark.long
def test_sweeps_from_far_away_jump_where_those_from_near_do() -> None:
    # On the way to its fold the motion has passed the height between it and the landing
    # once already, and far behind it does so again.
    problem, (fold, _) = duffing()
    (far, _) = folds_of(problem, traced(problem, 0.8, 2.4), lead=0.8)
    rates = [4e-4, 2e-4, 1e-4, 5e-5]

    (near_jump,) = jumps(problem, [fold], rates)
    (far_jump,) = jumps(problem, [far], rates)

    np.testing.assert_allclose(far_jump.frequency, near_jump.frequency, rtol=5e-4)
    # and the slowest ends there
    assert far_jump.envelopes[-1][0][-1] < 0.7 * far.end


@pytest.mark.long
def test_rates_follow_the_square_of_a_folds_frequency_unless_they_are_given() -> None:
    problem, _ = duffing()
    (_, fold) = folds_of(problem, traced(problem, 0.8, 2.4), lead=0.005)

    (jump,) = jumps(problem, [fold])

    np.testing.assert_allclose(jump.rates, fold.hertz**2 * np.array(RELATIVE))
    assert abs(jump.extrapolated - fold.hertz) < admitted(jump)


def mass(*elements: Element, drive: float) -> Problem:
    """Return a lightly damped mass on a spring, of 1 rad/s, and on elements."""
    return system(
        mass=[1.0],
        stiffness=[1.0],
        damping=[0.06],
        elements=elements,
        drive={"x1": drive},
    )


def cubic(stiffness: float) -> Element:
    return Element(CubicSpring(cubic=stiffness), between=("x1", "ground"))


SLIDER = Element(Jenkins(stiffness=1.0, limit=0.1), between=("x1", "ground"))
FOLDED = {
    "softening": (mass(cubic(-0.05), drive=0.15), 0.5, 1.2),
    "slider": (mass(cubic(1.0), SLIDER, drive=0.4), 0.8, 2.4),
}
"""problem, and where its curve has two folds [rad/s]"""


@pytest.mark.long
@pytest.mark.slow(seconds=10)
def test_the_told_error_is_that_of_the_fit_and_of_the_time_steps() -> None:
    problem, low, high = FOLDED["softening"]
    folds = folds_of(problem, traced(problem, low, high, harmonics=31), lead=0.008)
    assert {fold.upward for fold in folds} == {True, False}

    for jump in jumps(problem, folds):
        away = abs(jump.extrapolated - jump.fold.hertz)
        assert away <= jump.error < 1e-3 * jump.fold.hertz
        # without friction the fit is much better than the steps
        assert jump.fit_error < away <= jump.step_error


@pytest.mark.parametrize("fastest", [0.1, 4e-3])
def test_sweeps_too_fast_to_jump_on_their_way_are_refused(fastest: float) -> None:
    problem, (fold, _) = duffing()

    with pytest.raises(StudyError, match="give slower sweeps"):
        list(jumps(problem, [fold], [fastest * each for each in (1.0, 0.9, 0.8, 0.7)]))


def test_too_few_rates_are_refused() -> None:
    problem, folds = duffing()

    with pytest.raises(StudyError, match="at least 4"):
        list(jumps(problem, folds, [1e-4, 1e-4, 1e-4, 5e-5]))


@pytest.mark.long
@pytest.mark.slow(seconds=25)
def test_the_rig_with_falling_friction_jumps_on_its_upper_fold() -> None:
    # Under 1.9 N the excited blade leaves 1 mm for 0.26 mm at 137.17 Hz.
    problem = rig_problem(model="A", friction__law="gkf", excitation__force="1.9 N")
    folds = folds_of(problem, traced(problem, TURN * 133.0, TURN * 140.0), lead=5e-3)
    (fold,) = [each for each in folds if each.upward and each.hertz > 136.0]

    (jump,) = jumps(problem, [fold])

    assert abs(jump.extrapolated - fold.hertz) < admitted(jump)
