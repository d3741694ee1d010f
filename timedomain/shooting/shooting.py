"""The public function of shooting: periodic orbits as fixed points (theory §7.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

from microslip_mechanics.contact.memory import beyond_motion, remembers
from microslip_mechanics.contact.points import RIGID
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.record.start import Start
from timedomain.shooting.closed_march import ClosedMarch, ShootingError
from timedomain.shooting.floquet import FALL
from timedomain.shooting.found_orbit import astray, found_orbit
from timedomain.shooting.period_map import BLOCK, PeriodMap
from timedomain.shooting.periodic_orbit import (
    PeriodicOrbit,
    amplitude_error,
    extrapolated,
)


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
    difference of the two is the error that is reported (:func:`amplitude_error`). Where
    both err alike it is small by chance: the least is what a second order leaves of
    that of half the steps, a quarter.

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
    before = _before(coarse, chosen, near)
    while True:
        finer = PeriodMap.of(problem, frequency, 2 * coarse.map.steps)
        try:
            fine = found_orbit(finer, coarse.state, near)
        except ShootingError:
            if 4 * finer.steps > chosen.most:
                raise
            more = replace(chosen, steps=2 * finer.steps)
            coarse = _first(problem, frequency, start, more, near)
            before = _before(coarse, more, near)
            continue
        last = amplitude_error(coarse, fine)
        error = max(last, before.error / FALL)
        if error <= chosen.error or 2 * finer.steps > chosen.most:
            told = error if math.isfinite(error) else last
            return extrapolated(coarse, fine, told, before.march)
        coarse, before = fine, _Before(last, coarse)


class _Before(NamedTuple):
    """What is known of the coarser of two orbits by half its steps."""

    error: float
    """of the amplitudes, infinite if it is not known"""
    march: ClosedMarch | None
    """with half the steps"""


def _before(
    coarse: ClosedMarch, chosen: ShootingOptions, near: PeriodicResponse | None
) -> _Before:
    """Return what half the steps tell of the coarser of two orbits.

    The error is 0 where nothing depends on it, since steps cannot be doubled any more,
    and where half of them are too few to be marched.
    """
    carried = coarse.map
    half, odd = divmod(carried.steps, 2)
    if odd or half < 2 * BLOCK or 4 * carried.steps > chosen.most:
        return _Before(0.0, None)
    halved = PeriodMap.of(carried.problem, carried.frequency, half)
    try:
        march = found_orbit(halved, coarse.state, near)
    except ShootingError:
        return _Before(math.inf, None)
    return _Before(amplitude_error(march, coarse), march)


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
    steps, other = chosen.steps, None
    while True:
        carried = PeriodMap.of(problem, frequency, steps)
        last = 4 * steps > chosen.most
        try:
            found = found_orbit(carried, carried.state(start), near)
            if near is None or not astray(found, near):
                return found
            other = other or found
        except ShootingError:
            if last and other is None:
                raise
        if last and other is not None:
            return other
        steps *= 2
