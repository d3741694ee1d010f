"""How many motions the rig with falling friction has at one drive, by marches.

Harmonic balance finds one response at 136.8 Hz under 1 N, whatever is sought beside the
curve, and three under 1.9 N.
"""

import dataclasses
import functools
import itertools

import numpy as np
import pytest

from hbm.curves.parameter_curves import parameter_response
from hbm.options import CurveOptions
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from rigs import rig_problem
from small_problems import dwelled, from_rest, last_harmonic
from timedomain.record.start import Start

FREQUENCY = 2.0 * np.pi * 136.8
LOUD, PERIODS, STEPS = 3.0, 1300, 400


@functools.cache
def model_a() -> Problem:
    return rig_problem(model="A", friction__law="gkf")


def under(share: float) -> Problem:
    """Return the rig under a drive of so many newtons."""
    problem = model_a()
    return dataclasses.replace(problem, drive=share * problem.drive)


@functools.cache
def family() -> list[PeriodicResponse]:
    """Return the responses from little drive to much, through both folds."""
    options = CurveOptions(0.5, LOUD, error=3e-3, largest_step=0.1, stability=False)
    return list(parameter_response(under, FREQUENCY, options))


def amplitude(response: PeriodicResponse) -> float:
    """Return the first harmonic of the excited blade [m]."""
    return float(np.hypot(*response.coefficients[1:3] @ model_a().probes.rows[0]))


def passed(drive: float) -> list[float]:
    """Return the amplitudes at which the family passes a drive [m]."""
    points = [(each.parameter, amplitude(each)) for each in family()]
    return [
        before + (drive - first) / (last - first) * (after - before)
        for (first, before), (last, after) in itertools.pairwise(points)
        if (first - drive) * (last - drive) < 0.0
    ]


def marched(drive: float, start: Start) -> float:
    """Return the amplitude of the excited blade after many periods [m]."""
    history = dwelled(
        under(drive), FREQUENCY, periods=PERIODS, steps=STEPS, start=start
    )
    return float(np.abs(last_harmonic(history)[0]))


def loud() -> Start:
    """Return a state of the motion under three newtons."""
    return Start(*(part[0] for part in family()[-1].at(np.zeros(1))))


@pytest.mark.long
@pytest.mark.slow
def test_under_one_newton_large_motions_die_down_to_the_only_one() -> None:
    (only,) = passed(1.0)

    assert amplitude(family()[-1]) > 20.0 * only
    assert marched(1.0, loud()) == pytest.approx(only, rel=0.02)


@pytest.mark.long
@pytest.mark.slow
def test_under_1_9_newtons_the_history_decides_between_two_of_three() -> None:
    low, middle, high = sorted(passed(1.9))

    assert low < 0.8 * middle
    assert middle < 0.3 * high
    assert marched(1.9, loud()) == pytest.approx(high, rel=0.02)
    assert marched(1.9, from_rest(under(1.9))) == pytest.approx(low, rel=0.02)
