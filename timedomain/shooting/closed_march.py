"""A march of one period that ends where it began: Newton's iteration (theory §7.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.errors import MicroslipError
from timedomain.integrate import IntegrationError
from timedomain.shooting.gap_slope import GapSlope
from timedomain.shooting.period_map import Period, PeriodMap
from timedomain.shooting.period_sensitivity import sensitivity_of

ITERATIONS, HALVINGS = 30, 8
CLOSED = 1e-8
"""largest last change of the state, over the vibration"""
LOOSE = 10.0
"""times as much, of the gap where a direction is left out of the changes"""
ROUNDING = 1e-13
"""of a state"""
LEAP = 1e-3
"""largest change, over the vibration, that may be left where none brings end and
beginning closer together: friction limits that jump as faces touch make a march leap"""
CHORD = 0.1
"""of the gap: what a step leaves, up to which its derivative serves again"""


class ShootingError(MicroslipError):
    """A periodic orbit that Newton's iteration does not reach."""


@dataclass(frozen=True, slots=True)
class ClosedMarch:
    """A march of one period that ends where it began."""

    map: PeriodMap
    state: Array
    """at phase 0, shape (states,)"""
    period: Period
    neutral: int
    """directions in which the orbit is not pinned"""
    gap: float
    """distance of end and beginning, over the vibration"""
    iterations: int
    left: float = 0.0
    """last change, over the vibration, if that brought them no closer"""

    def monodromy(self) -> Array:
        """Return the derivative of the end by the beginning, (states, states)."""
        with np.errstate(over="ignore", invalid="ignore"):
            return sensitivity_of(self.map, self.period).monodromy


def closed(carried: PeriodMap, state: Array) -> ClosedMarch:
    """Return the orbit of one number of steps by Newton's iteration.

    Sliders that never slip carry no mean traction, or as little as their limits admit.
    Directions in which nothing pins the state, such as the mean position of a body
    that nothing but friction holds, are left out of each change: of all orbits the
    nearest is returned.

    Raises
    ------
    ShootingError
        If it does not converge.
    """
    marched = _marched(carried, state)
    slope, own = _slope(carried, marched[0]), True
    for iteration in range(1, ITERATIONS + 1):
        period, gap = marched
        unit, change = _unit(carried, state, period), slope.change(gap)
        size, apart = float(np.linalg.norm(change)), float(np.linalg.norm(gap))
        found = ClosedMarch(
            carried, state, period, slope.neutral, apart / unit, iteration
        )
        if size <= CLOSED * unit:
            return _held(found)
        closer = _closer(found, change, gap, HALVINGS if own else 1)
        if closer is None and own:
            if size <= LEAP * unit:
                return replace(found, left=size / unit)
            raise ShootingError(
                f"{_at(carried)}: Newton's change does not bring end and beginning "
                "together: there may be no orbit near the start, as beyond a fold; "
                "give a closer start"
            )
        state, marched = closer or (state, marched)
        share = float(np.linalg.norm(marched[1])) / apart
        own = share > CHORD or not slope.holds(marched[0])
        if own:
            slope = _slope(carried, marched[0])
    raise ShootingError(
        f"{_at(carried)} does not converge in {ITERATIONS} iterations: "
        "give a closer start or more steps"
    )


def _held(found: ClosedMarch) -> ClosedMarch:
    """Return an orbit; an error where a body drifts that nothing holds."""
    if found.neutral and found.gap > LOOSE * CLOSED:
        raise ShootingError(
            f"{_at(found.map)}: each period moves by {found.gap / CLOSED:.1e} of "
            "what is accepted a body that nothing holds: hold it by a spring"
        )
    return found


def _closer(
    before: ClosedMarch, change: Array, gap: Array, attempts: int
) -> tuple[Array, tuple[Period, Array]] | None:
    """Return the state after a change, halved until the period closes better.

    None if it never does. Where sliders slip only just, no change of more than one
    attempt may do so: they settle by their own march.
    """
    carried, apart = before.map, np.linalg.norm(gap)
    for halvings in range(attempts):
        trial = before.state + 0.5**halvings * change
        try:
            marched = _marched(carried, trial)
        except ShootingError:
            continue
        if np.linalg.norm(marched[1]) < apart:
            return trial, marched
    settled = carried.settled(before.state, before.period)
    if attempts == 1 or np.array_equal(settled, before.state):
        return None
    return settled, _marched(carried, settled)


def _marched(carried: PeriodMap, state: Array) -> tuple[Period, Array]:
    """Return one period from a state, and by how much it does not close."""
    with np.errstate(over="ignore", invalid="ignore"):
        try:
            period = carried.march(state)
        except IntegrationError as error:
            raise ShootingError(f"{_at(carried)}: {error}") from error
        gap = carried.gap(state, period)
    if not np.isfinite(gap).all():
        raise ShootingError(f"{_at(carried)} leaves all bounds: give a closer start")
    return period, gap


def _slope(carried: PeriodMap, period: Period) -> GapSlope:
    """Return how the gap of a period goes with the state."""
    try:
        with np.errstate(over="ignore", invalid="ignore"):
            return GapSlope.of(carried, period)
    except np.linalg.LinAlgError as error:
        raise ShootingError(
            f"{_at(carried)}: small motions grow beyond all numbers"
        ) from error


def _unit(carried: PeriodMap, state: Array, period: Period) -> float:
    """Return how large the motion about its mean is, in the norm of states.

    It is never less than what rounding leaves of the state.
    """
    moved = period.displacement[1:] - period.displacement[1:].mean(axis=0)
    states = np.hstack([moved, period.velocity[1:] / carried.frequency])
    to_modes = np.kron(np.eye(2), carried.structure.inverse)
    size = np.linalg.norm(states @ to_modes.T, axis=1)
    rounded = ROUNDING / CLOSED * float(np.linalg.norm(state))
    return max(float(np.sqrt(np.mean(size**2))) + rounded, TINY)


def _at(carried: PeriodMap) -> str:
    hertz = carried.frequency / math.tau
    return f"shooting at {hertz:.6g} Hz with {carried.steps} steps"
