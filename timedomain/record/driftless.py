"""The velocity with which what nothing holds does not drift under its loads (§6.1)."""

from __future__ import annotations

import math

import numpy as np
from scipy.integrate import simpson

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.loads.segments import clock, factors_over
from microslip_mechanics.problem import Problem
from microslip_mechanics.structures.unheld import dragged, unheld_motions

DENSE, FEWEST, MOST = 64, 4096, 1 << 22
"""moments of a cycle of the drive, and of each segment, at which loads are summed; of a
history at least and at most"""


def undragged_motions(problem: Problem) -> Array:
    """Return what neither stiffness, damping nor contacts hold, (dofs, motions)."""
    structure = problem.structure.dense
    _, selection = problem.interface.relative_motion()
    motions = unheld_motions(structure, selection)
    return motions[:, :0] if dragged(structure, motions) else motions


def driftless(problem: Problem, history: LoadHistory) -> Array:
    """Return the velocity to begin with [m/s], shape (dofs,): zero for what is held.

    A free body that begins at rest under a sine drifts away with the velocity that its
    first half cycle leaves. With this one the mean of its velocity vanishes over the
    time in which it is driven. It moves on its own, so that its loads tell.
    """
    motions = undragged_motions(problem)
    if not motions.size:
        return np.zeros(problem.structure.dofs)
    pushes = motions.T @ problem.loads.T
    return -motions @ (pushes @ _mean_momenta(history, len(problem.loads)))


def _mean_momenta(history: LoadHistory, loads: int) -> Array:
    """Return the means of the integrals of the load factors [s], shape (loads,)."""
    segments = history.segments()
    cycles = np.ptp(clock(segments, np.array([0.0, history.duration]))[:, 2]) / math.tau
    moments = FEWEST + DENSE * (cycles + segments.begin.size)
    time = np.linspace(0.0, history.duration, 1 + min(2 * int(moments / 2), MOST))
    factors = factors_over(segments, time, loads)
    driven = np.flatnonzero(factors[:, 1:].any(axis=1))
    if not driven.size:
        return np.zeros(loads)
    first, last = time[max(driven[0] - 1, 0)], time[min(driven[-1] + 1, time.size - 1)]
    left = np.clip((last - time) / (last - first), 0.0, 1.0)
    momenta: Array = simpson(left[:, None] * factors, x=time, axis=0)
    return momenta
