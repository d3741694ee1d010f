"""What time steps and rows change in a decay, as longer ones tell."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from microslip.studies.decay import swings
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.ring_down import RingDown
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.step_doubling import CAUTION


class StepErrors(NamedTuple):
    """What steps and rows change in a decay; NaN where there are no swings."""

    frequency: float
    """largest, over the largest natural frequency"""
    damping: float
    """largest, over the largest damping ratio, of both that are told"""
    usual: float
    """of the damping ratio, in the median"""


def step_errors(
    problem: Problem, fine: RingDown, coarse: TimeHistory, probe: int
) -> StepErrors:
    """Return what steps and rows change in a decay, as longer ones tell.

    Rows of the other decay are taken two by two: extremes lie between rows, by a cubic.

    Parameters
    ----------
    problem, probe
        What decays, and where that is seen.
    fine
        The decay that is measured.
    coarse
        The same decay, marched with steps twice as long. Where several motions beat
        one of both may have a swing more: they are compared at the same time.
    """
    other = swings(problem, coarse, probe, every=2)
    if not (fine.time.size and other.time.size):
        return StepErrors(math.nan, math.nan, math.nan)
    both = fine.time <= max(other.time[-1], fine.time[0])
    nearest = np.searchsorted(0.5 * (other.time[1:] + other.time[:-1]), fine.time)

    def apart(one: Array, two: Array) -> Array:
        away: Array = CAUTION * np.abs(one - two[nearest])[both]
        return away

    def share(one: Array, two: Array) -> float:
        largest = float(np.nanmax(np.abs(one[both]), initial=0.0)) or 1.0
        return float(np.nanmax(apart(one, two), initial=0.0)) / largest

    damping = (
        (fine.damping, other.damping),
        (fine.energy_damping, other.energy_damping),
    )
    return StepErrors(
        share(fine.frequency, other.frequency),
        max(share(*pair) for pair in damping if pair[0].size),
        float(np.median(apart(fine.damping, other.damping))),
    )
