"""Small motions over a period in which points touch or lift off (theory §7.3)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import RIGID
from timedomain.shooting.contact_jumps import contact_jumps, passes
from timedomain.shooting.monodromy import monodromy_of
from timedomain.shooting.period_map import Period, PeriodMap
from timedomain.shooting.period_sensitivity import carried_state

PARTS = 32
"""of a step, in which tangents are looked at"""


def small_motions(period_map: PeriodMap, period: Period) -> Array | None:
    """Return what becomes of a small motion in a period, (states, states).

    The march's own derivative knows the time that a stop is touched to whole steps
    only. Here the tangents of steps in which a point touches or parts are means over
    them, along a motion that is linear from sample to sample, and what jumps there is
    counted. None where no point does, or contacts are rigid.
    """
    if (period_map.problem.interface.points.friction == RIGID).any():
        return None
    passed = _touching(period_map, period)
    if not passed.size:
        return None
    tangents = _mean_tangents(period_map, period, passed)
    if period_map.sliders.count:
        return carried_state(period_map, period, tangents).monodromy
    return monodromy_of(period_map, tangents)


def _touching(period_map: PeriodMap, period: Period) -> NDArray[np.int64]:
    """Return the steps in which a point touches or lifts off."""
    moved, _ = period_map.points(period.displacement, period.velocity)
    found = passes(period_map.problem.interface.points, moved)
    return np.flatnonzero(found.any(axis=1))


def _mean_tangents(
    period_map: PeriodMap, period: Period, passed: NDArray[np.int64]
) -> Array:
    """Return the tangents at the samples, shared by the half steps around each.

    Each half of the steps ``passed`` has the mean over itself instead.
    """
    motion = period.displacement, period.velocity
    samples = period_map.points(*(each[:-1] for each in motion))
    own = period_map.tangents(samples, 0.0)
    halves = own / 2.0, np.roll(own, -1, axis=0) / 2.0
    shares = np.split((np.arange(PARTS) + 0.5) / PARTS, 2)
    for half, parts in zip(halves, shares, strict=True):
        along = parts[:, None, None]
        between = [
            ((1.0 - along) * each[passed] + along * each[passed + 1]).reshape(
                -1, each.shape[1]
            )
            for each in motion
        ]
        found = period_map.tangents(period_map.points(*between), 0.0)
        half[passed] = found.reshape(parts.size, passed.size, *own.shape[1:]).sum(0)
        half[passed] /= PARTS
    for step, share, stiffness in contact_jumps(period_map, period):
        halves[0][step] += (1.0 - share) * stiffness
        halves[1][step] += share * stiffness
    mean = halves[0] + np.roll(halves[1], 1, axis=0)
    return np.concatenate([mean, mean[:1]])
