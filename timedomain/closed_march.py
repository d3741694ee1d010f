"""A march of one period that ends where it began: Newton's iteration (theory §7)."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from timedomain.integrate import IntegrationError
from timedomain.period_map import Period, PeriodMap
from timedomain.period_sensitivity import gap_slope, sensitivity_of

ITERATIONS, HALVINGS = 30, 8
CLOSED = 1e-8
"""largest last change of the state, over the vibration"""
LOOSE = 10.0
"""times as much, of the gap where a direction is left out of the changes"""
ROUNDING = 1e-13
"""of a state"""
LEAP = 1e-3
"""largest change, over the vibration, that may be left where none brings end and
beginning closer together: forces that jump as faces touch make a march of steps leap"""
NEUTRAL = 1e-10
"""of the largest singular value of 1 − Φ: below it a direction stays where it is"""


class ShootingError(MicroslipError):
    """A periodic orbit that Newton's iteration does not reach."""


@dataclass(frozen=True, slots=True)
class ClosedMarch:
    """A march of one period that ends where it began, and its derivative."""

    map: PeriodMap
    state: Array
    """at phase 0, shape (states,)"""
    period: Period
    monodromy: Array
    """of the motion, shape (states, states)"""
    neutral: int
    """directions in which the orbit is not pinned"""
    gap: float
    """distance of end and beginning, over the vibration"""
    iterations: int
    left: float = 0.0
    """last change, over the vibration, if that brought them no closer"""


def closed(carried: PeriodMap, state: Array, until: float = math.inf) -> ClosedMarch:
    """Return the orbit of one number of steps by Newton's iteration.

    It is given up where :func:`time.process_time` has passed ``until`` [s].

    Sliders that never slip carry no mean traction, or as little as their limits admit.
    Directions along which 1 − Φ has a singular value below :data:`NEUTRAL` of the
    largest, such as the mean position of a body that nothing but friction holds, are
    left out of each change: of all orbits the nearest is returned.

    Raises
    ------
    ShootingError
        If it does not converge.
    """
    marched = _marched(carried, state, until)
    for iteration in range(1, ITERATIONS + 1):
        period, gap = marched
        sensitivity = sensitivity_of(carried, period)
        slope = gap_slope(carried, period, sensitivity)
        change, neutral = _change(slope, gap)
        vibration = _vibration(carried, period)
        accepted = CLOSED * vibration + ROUNDING * float(np.linalg.norm(state))
        apart, size = float(np.linalg.norm(gap)), float(np.linalg.norm(change))
        found = ClosedMarch(
            carried, state, period, sensitivity.monodromy, neutral,
            apart / max(accepted / CLOSED, 1e-300), iteration,
        )  # fmt: skip
        if size <= accepted:
            if neutral and apart > LOOSE * accepted:
                raise ShootingError(
                    f"{_at(carried)}: each period moves by {apart / accepted:.1e} of "
                    "what is accepted a body that nothing holds: hold it by a spring"
                )
            return found
        try:
            state, marched = _closer(carried, state, change, marched, until)
        except ShootingError:
            if size > LEAP * vibration:
                raise
            return replace(found, left=size / vibration)
    raise ShootingError(
        f"{_at(carried)} does not converge in {ITERATIONS} iterations: "
        "give a closer start or more steps"
    )


def _change(slope: Array, gap: Array) -> tuple[Array, int]:
    """Return Newton's change of least norm, and how many directions it leaves out."""
    left, sizes, right = np.linalg.svd(slope)
    kept = sizes > NEUTRAL * sizes[0]
    change: Array = right[kept].T @ ((left[:, kept].T @ gap) / sizes[kept])
    return change, int(gap.size - kept.sum())


def _closer(
    carried: PeriodMap,
    state: Array,
    change: Array,
    before: tuple[Period, Array],
    until: float,
) -> tuple[Array, tuple[Period, Array]]:
    """Return the state after a change, halved until the period closes better.

    Where sliders slip only just, no change may do so: they settle by their own march.
    """
    period, gap = before
    for halvings in range(HALVINGS):
        trial = state + 0.5**halvings * change
        try:
            marched = _marched(carried, trial, until)
        except ShootingError:
            continue
        if np.linalg.norm(marched[1]) < np.linalg.norm(gap):
            return trial, marched
    settled = carried.settled(state, period)
    if not np.array_equal(settled, state):
        return settled, _marched(carried, settled, until)
    raise ShootingError(
        f"{_at(carried)}: Newton's change does not bring end and beginning together: "
        "there may be no orbit near the start, as beyond a fold; give a closer start"
    )


def _marched(carried: PeriodMap, state: Array, until: float) -> tuple[Period, Array]:
    """Return one period from a state, and by how much it does not close."""
    if time.process_time() > until:
        raise ShootingError(f"{_at(carried)} is out of time")
    with np.errstate(over="ignore", invalid="ignore"):
        try:
            period = carried.march(state)
        except IntegrationError as error:
            raise ShootingError(f"{_at(carried)}: {error}") from error
        gap = carried.gap(state, period)
    if not np.isfinite(gap).all():
        raise ShootingError(f"{_at(carried)} leaves all bounds: give a closer start")
    return period, gap


def _vibration(carried: PeriodMap, period: Period) -> float:
    """Return how large the motion about its mean is, in the norm of states."""
    moved = period.displacement[1:] - period.displacement[1:].mean(axis=0)
    states = np.hstack([moved, period.velocity[1:] / carried.frequency])
    to_modes = np.kron(np.eye(2), carried.structure.inverse)
    size = np.linalg.norm(states @ to_modes.T, axis=1)
    return float(np.sqrt(np.mean(size**2)))


def _at(carried: PeriodMap) -> str:
    hertz = carried.frequency / math.tau
    return f"shooting at {hertz:.6g} Hz with {carried.steps} steps"
