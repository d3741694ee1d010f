"""A mass that meets a stiff stop as its drive grows: the response folds as it touches.

Below the drive at which it touches it is linear; a little above that, while it hardly
touches, the stop has turned the curve back.
"""

import math
from functools import partial

import numpy as np
import pytest

import microslip
from microslip_mechanics.problem import Problem

GAP, STOP, SPRING, RATIO = 3e-4, 7766.186283597285, 1e3, 0.022446267274305202


def pushed(force: float) -> Problem:
    """Return a mass of 1 kg that is 0.3 mm from a stop, under a force [N]."""
    stop = microslip.UnilateralSpring(stiffness=STOP, gap=GAP)
    return microslip.system(
        mass=[1.0],
        stiffness=[SPRING],
        damping_ratio=RATIO,
        elements=[microslip.Element(stop, between=("x1", "ground"), name="stop")],
        drive={"x1": force},
    )


def touching(hertz: float) -> float:
    """Return the drive [N] at which the linear motion is as large as the gap."""
    turn = math.tau * hertz
    damping = 2.0 * RATIO * math.sqrt(SPRING)
    return GAP * abs(complex(SPRING - turn**2, turn * damping))


@pytest.mark.parametrize("hertz", [5.2, 6.5])
def test_the_curve_folds_where_the_stop_is_touched(hertz: float) -> None:
    """More harmonics took it from the first touch to the loud motion, over both folds;
    or the fold was told as a branch point.
    """
    follow = partial(microslip.follow, pushed, 0.01, 2.0, frequency=hertz)

    curve = follow(tolerance=1e-3)

    events = [each for each in curve.event if each not in ("", "peak")]
    assert events == ["fold", "fold"]
    assert np.abs(np.diff(np.log(curve.amplitude[:, 0]))).max() < 0.5
    folded = curve.parameter[np.array(curve.event) == "fold"]
    assert folded[0] == pytest.approx(touching(hertz), rel=1e-2)
    assert folded[0] > touching(hertz)
    assert folded[1] < 0.7 * folded[0]


def test_a_fold_is_told_where_planes_across_meet_the_quiet_motion_too() -> None:
    """About the fold behind which the mass is loud again, at steps of few harmonics."""
    coarse, fine = (
        microslip.follow(pushed, 0.01, 0.1, frequency=5.3625, tolerance=tolerance)
        for tolerance in (1e-3, 1.9e-4)
    )

    (one,), (other,) = (
        np.flatnonzero((np.array(each.event) == "fold") & (each.parameter < 0.03))
        for each in (coarse, fine)
    )
    doubt = coarse.parameter_error[one] + fine.parameter_error[other]
    assert doubt < 1e-6  # N
    assert abs(coarse.parameter[one] - fine.parameter[other]) < doubt

    (turned,) = np.flatnonzero(
        (np.array(coarse.event) == "fold") & (coarse.parameter > 0.03)
    )
    # where the stop is touched, as tolerances of 1.9e-4 and 3e-5 have it
    assert abs(coarse.parameter[turned] - 0.04304636) < coarse.parameter_error[turned]
    assert coarse.parameter_error[turned] < 2e-5


@pytest.mark.long
def test_the_fold_at_the_touch_is_told_where_the_range_begins_just_below() -> None:
    """There the curve began anew before the fold, from a point of few harmonics."""
    curve = microslip.follow(pushed, 0.03, 0.06, frequency=5.3625, tolerance=1e-3)

    (fold,) = np.flatnonzero(np.array(curve.event) == "fold")
    error = curve.parameter_error[fold]
    assert abs(curve.parameter[fold] - 0.04304636) < 1e-8 + error
    assert error < 1e-6
