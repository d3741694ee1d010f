"""Dormand and Prince's method of order 8, compiled, with scipy's coefficients.

Step control is that of Hairer, Nørsett and Wanner, "Solving Ordinary Differential
Equations I", section II.4 and the appendix's DOP853.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.integrate._ivp import dop853_coefficients as published

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel
from timedomain.first_order.first_order_rate import flow
from timedomain.first_order.first_order_system import System

STAGES = 12
SAFETY, SMALLEST, LARGEST = 0.9, 0.2, 10.0
"""factors of a new step"""


class Tableau(NamedTuple):
    """Coefficients of the method."""

    inner: Array
    """a, shape (12, 12)"""
    nodes: Array
    """c, shape (12,)"""
    outer: Array
    """b, shape (12,)"""
    third: Array
    """of the error estimate of order 3, shape (13,)"""
    fifth: Array
    """of that of order 5, shape (13,)"""


DOP853 = Tableau(
    np.ascontiguousarray(published.A[:STAGES, :STAGES]),
    published.C[:STAGES].copy(),
    published.B.copy(),
    published.E3.copy(),
    published.E5.copy(),
)


@kernel
def integrated(
    tableau: Tableau,
    system: System,
    times: Array,
    state: Array,
    relative: float,
    absolute: float,
    first: float,
    most: int,
) -> tuple[Array, int, int]:
    """Return states at times, the first of which is that of ``state``.

    Parameters
    ----------
    tableau, system
        The method, and what is integrated.
    times
        Increasing, [s], shape ``(times,)``.
    state
        At the first time; unchanged.
    relative, absolute
        Tolerances; both zero keeps the first step fixed.
    first
        First step [s].
    most
        Steps, accepted or not, after which the states from there on stay NaN.

    Returns
    -------
    states, accepted, rejected
        The states have shape ``(times, size)``.
    """
    states = np.full((times.size, state.size), np.nan)
    states[0] = state
    now, trial = state.copy(), np.empty_like(state)
    stages = np.empty((STAGES + 1, state.size))
    flow(system, times[0], now, stages[0])
    adaptive = relative > 0.0 or absolute > 0.0
    time, step, accepted, rejected, grown = times[0], first, 0, 0, LARGEST
    for place in range(1, times.size):
        while time < times[place]:
            if accepted + rejected >= most:
                return states, accepted, rejected
            left = times[place] - time
            last = step > 0.999999 * left
            taken = left if last else step
            _stages(tableau, system, time, now, taken, stages, trial)
            wrong = _error(tableau, now, trial, stages, taken, relative, absolute)
            if not wrong <= 1.0:
                rejected += 1
                step, grown = taken * _factor(wrong, 1.0), 1.0
                continue
            accepted += 1
            time = times[place] if last else time + taken
            now, trial = trial, now
            stages[0] = stages[STAGES]
            if adaptive:
                wanted = taken * _factor(wrong, grown)
                step = max(step, wanted) if last else wanted
            grown = LARGEST
        states[place] = now
    return states, accepted, rejected


@kernel
def _stages(
    tableau: Tableau,
    system: System,
    time: float,
    now: Array,
    step: float,
    stages: Array,
    trial: Array,
) -> None:
    """Write the rates of all stages but the first, and the new state with its rate."""
    for stage in range(1, STAGES):
        moved = np.dot(tableau.inner[stage, :stage], stages[:stage])
        for i in range(now.size):
            trial[i] = now[i] + step * moved[i]
        flow(system, time + tableau.nodes[stage] * step, trial, stages[stage])
    moved = np.dot(tableau.outer, stages[:STAGES])
    for i in range(now.size):
        trial[i] = now[i] + step * moved[i]
    flow(system, time + step, trial, stages[STAGES])


@kernel
def _error(
    tableau: Tableau,
    now: Array,
    trial: Array,
    stages: Array,
    step: float,
    relative: float,
    absolute: float,
) -> float:
    """Return the estimated error over what is tolerated; 0 without tolerances."""
    if relative == 0.0 and absolute == 0.0:
        return 0.0
    fifth, third = np.dot(tableau.fifth, stages), np.dot(tableau.third, stages)
    five, three = 0.0, 0.0
    for i in range(now.size):
        tolerated = absolute + relative * max(abs(now[i]), abs(trial[i]))
        five += (fifth[i] / tolerated) ** 2
        three += (third[i] / tolerated) ** 2
    if five == 0.0 and three == 0.0:
        return 0.0
    return float(step * five / np.sqrt((five + 0.01 * three) * now.size))


@kernel
def _factor(wrong: float, largest: float) -> float:
    """Return by what to multiply a step with this error; NaN shrinks it."""
    if wrong == 0.0:
        return largest
    if not wrong < np.inf:
        return SMALLEST
    return float(min(largest, max(SMALLEST, SAFETY * wrong**-0.125)))


def real_limit(tableau: Tableau) -> float:
    """Return how far stability reaches on the negative real axis."""

    def growth(reach: float) -> float:
        inverse = np.linalg.inv(np.eye(STAGES) + reach * tableau.inner)
        return float(abs(1.0 - reach * tableau.outer @ inverse.sum(axis=1)))

    reaches = np.arange(0.01, 20.0, 0.01)
    return float(next(each for each in reaches if growth(each) > 1.0))
