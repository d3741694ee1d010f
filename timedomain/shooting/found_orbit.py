"""The orbit of one number of steps, close to a motion that is known (theory §7.3)."""

from __future__ import annotations

import math

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.shooting.closed_march import ClosedMarch, ShootingError, closed
from timedomain.shooting.period_map import PeriodMap
from timedomain.shooting.periodic_orbit import first_harmonic
from timedomain.shooting.whole_orbit import whole_orbit

ASTRAY = 0.1
"""change of the first harmonic, relative, from which an orbit may be another one, …"""
DOUBT = 3.0
"""… unless it is below so many times the error, if known, of the response beside it"""


def found_orbit(
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
    if near is None or not astray(marched, near):
        return marched
    try:
        whole = whole_orbit(carried, near)
    except ShootingError:
        return marched
    return min(marched, whole, key=lambda each: _away(each, near))


def astray(marched: ClosedMarch, near: PeriodicResponse) -> bool:
    """Return whether an orbit seems to be another one than the response beside it."""
    doubt = DOUBT * near.error if math.isfinite(near.error) else 0.0
    return _away(marched, near) > max(ASTRAY, doubt)


def _away(marched: ClosedMarch, near: PeriodicResponse) -> float:
    """Return how far the probes' first harmonic is from another motion's, relative."""
    rows = marched.map.problem.probes.rows
    wanted = near.coefficients[1:3] @ rows.T
    away = float(np.linalg.norm(first_harmonic(marched) @ rows.T - wanted))
    return away / max(float(np.linalg.norm(wanted)), TINY)
