"""How smooth friction may be while a curve is traced (theory §6.3)."""

from __future__ import annotations

import numpy as np

from hbm.balance.relative import RelativeProblem
from hbm.options import CurveOptions
from hbm.paths.path import Path
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import regularised
from microslip_mechanics.contact.points import GENERAL_KINETIC

SHARE = 3.0
"""of the sliding velocity without contact times the error: more is taken back"""
FALL = 0.1
"""of the Stribeck velocity, which is not smoothed over"""


def smoothest(path: Path, options: CurveOptions) -> float:
    """Return the threshold velocity with which a trace begins [m/s]; 0 for the given.

    It is a share of the sliding velocity without any contact, by the error that is
    asked for; where the estimate says that it is too much, it becomes less. Fixed
    harmonics, and friction that is as smooth already, stay as they are.
    """
    if options.harmonics is not None:
        return 0.0
    ends = [path.at(parameter) for parameter in (options.start, options.end)]
    sliding = [_rubbing(problem) for problem, _ in ends]
    if not all(rubbing.any() for rubbing in sliding):
        return 0.0
    speed = min(
        float(_free_speeds(*end)[rubbing].max())
        for end, rubbing in zip(ends, sliding, strict=True)
    )
    threshold = SHARE * options.error * speed
    for (problem, _), rubbing in zip(ends, sliding, strict=True):
        points = problem.points
        falls = rubbing & (points.friction == GENERAL_KINETIC)
        falls &= points.static != points.dynamic
        steepest = float(points.stribeck[falls].min(initial=np.inf))
        threshold = min(threshold, FALL * steepest)
        if threshold <= points.threshold[rubbing].min():
            return 0.0
    return threshold


def _rubbing(problem: RelativeProblem) -> Array:
    """Return at which points friction has a threshold velocity, shape (points,)."""
    count = problem.points.load.size
    return np.array(
        [regularised(problem.points, point) for point in range(count)], dtype=bool
    )


def _free_speeds(problem: RelativeProblem, frequency: float) -> Array:
    """Return how fast each point slides without contact [m/s], shape (points,)."""
    moving = np.abs(frequency * problem.apart(frequency)).reshape(-1, 3)
    speeds: Array = np.hypot(moving[:, 1], moving[:, 2])
    return speeds
