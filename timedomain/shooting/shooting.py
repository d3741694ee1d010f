"""The public function of shooting: periodic orbits as fixed points (theory §7.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.memory import beyond_motion, remembers
from microslip_mechanics.contact.points import RIGID
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.record.start import Start
from timedomain.shooting.closed_march import ClosedMarch, ShootingError, closed
from timedomain.shooting.period_map import BLOCK, PeriodMap
from timedomain.shooting.periodic_orbit import (
    PeriodicOrbit,
    amplitude_error,
    extrapolated,
    first_harmonic,
)
from timedomain.shooting.whole_orbit import whole_orbit

ASTRAY = 0.1
"""change of the first harmonic, relative, from which an orbit may be another one, …"""
DOUBT = 3.0
"""… unless it is below so many times the error, if known, of the response beside it"""


@dataclass(frozen=True, slots=True)
class ShootingOptions:
    """Steps and accuracy of a periodic orbit."""

    steps: int = 512
    """of the period in the coarser of the first two orbits"""
    error: float = 5e-4
    """steps are doubled until the amplitude's estimated relative error is below it"""
    most: int = 8192
    """steps of the finest orbit"""

    def __post_init__(self) -> None:
        """Check that orbits can be compared, and that a number of steps ends it."""
        if self.steps < 2 * BLOCK:
            raise ValueError(f"{self.steps} steps: give at least {2 * BLOCK}")
        if self.most < 2 * self.steps:
            raise ValueError(
                f"at most {self.most} steps: give at least {2 * self.steps}, twice the "
                "first number"
            )
        if not 0.0 < self.error < math.inf:
            raise ValueError(f"error {self.error:g}: give a positive finite number")


def periodic_orbit(
    problem: Problem,
    frequency: float,
    *,
    start: Start,
    options: ShootingOptions | None = None,
    near: PeriodicResponse | None = None,
) -> PeriodicOrbit:
    """Return the periodic motion near a start, stable or not.

    Two orbits, the second with twice the steps, give the extrapolated motion; the
    difference of the two is the error that is reported (:func:`amplitude_error`).

    Parameters
    ----------
    problem
        What moves.
    frequency
        Of the excitation [rad/s].
    start
        A motion at phase 0 close to the orbit, such as that of harmonic balance.
    options
        Steps and accuracy; the default ones if left out.
    near
        The whole motion to which ``start`` belongs: where a period that is marched from
        it does not close, or closes on another motion, all steps are found at once.

    Raises
    ------
    ShootingError
        If no orbit is reached, or if some contacts remember and others are rigid.
    ValueError
        If the frequency is not positive, or the structure sparse.
    """
    if not 0.0 < frequency < math.inf:
        raise ValueError(f"frequency {frequency:g} rad/s: give a positive finite one")
    points = problem.interface.points
    if remembers(points).any() and (points.friction == RIGID).any():
        raise ShootingError(
            "shooting knows contacts that remember and rigid ones, but not both at "
            "once: march to the steady state (dwell)"
        )
    chosen = options or ShootingOptions()
    if beyond_motion(points):
        near = None
    coarse = _first(problem, frequency, start, chosen, near)
    while True:
        finer = PeriodMap.of(problem, frequency, 2 * coarse.map.steps)
        try:
            fine = _found(finer, coarse.state, near)
        except ShootingError:
            if 4 * finer.steps > chosen.most:
                raise
            more = replace(chosen, steps=2 * finer.steps)
            coarse = _first(problem, frequency, start, more, near)
            continue
        error = amplitude_error(coarse, fine)
        if error <= chosen.error or 2 * finer.steps > chosen.most:
            return extrapolated(coarse, fine, error)
        coarse = fine


def _first(
    problem: Problem,
    frequency: float,
    start: Start,
    chosen: ShootingOptions,
    near: PeriodicResponse | None,
) -> ClosedMarch:
    """Return the orbit of the fewest steps that have one, and close to ``near``.

    Near a fold or a sharp peak those of too few steps have none at this frequency. If
    none of any steps is close, the first one that there is is returned.
    """
    steps, astray = chosen.steps, None
    while True:
        carried = PeriodMap.of(problem, frequency, steps)
        last = 4 * steps > chosen.most
        try:
            found = _found(carried, carried.state(start), near)
            if near is None or not _astray(found, near):
                return found
            astray = astray or found
        except ShootingError:
            if last and astray is None:
                raise
        if last and astray is not None:
            return astray
        steps *= 2


def _found(
    carried: PeriodMap, state: Array, near: PeriodicResponse | None
) -> ClosedMarch:
    """Return the orbit of one number of steps, marched or all steps at once.

    Where small motions grow fast a march closes on another orbit, and where they grow
    too fast on none.
    """
    try:
        marched = closed(carried, state)
    except ShootingError as error:
        if near is None:
            raise
        try:
            return whole_orbit(carried, near)
        except ShootingError as other:
            raise ShootingError(f"{error}; {other}") from other
    if near is None or not _astray(marched, near):
        return marched
    try:
        whole = whole_orbit(carried, near)
    except ShootingError:
        return marched
    return min(marched, whole, key=lambda each: _away(each, near))


def _astray(marched: ClosedMarch, near: PeriodicResponse) -> bool:
    """Return whether an orbit seems to be another one than the response beside it."""
    doubt = DOUBT * near.error if math.isfinite(near.error) else 0.0
    return _away(marched, near) > max(ASTRAY, doubt)


def _away(marched: ClosedMarch, near: PeriodicResponse) -> float:
    """Return how far the probes' first harmonic is from another motion's, relative."""
    rows = marched.map.problem.probes.rows
    wanted = near.coefficients[1:3] @ rows.T
    away = float(np.linalg.norm(first_harmonic(marched) @ rows.T - wanted))
    return away / max(float(np.linalg.norm(wanted)), TINY)
