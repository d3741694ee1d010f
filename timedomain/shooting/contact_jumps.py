"""What a force that jumps as faces touch does to small motions (theory §7.3)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.jump import contact_jump
from microslip_mechanics.contact.law import sudden
from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from timedomain.shooting.period_map import Period, PeriodMap

BESIDE = 1e-9
"""of the way of a step: how far from the edge both sides of it are looked at"""


class ContactJump(NamedTuple):
    """A force that jumps where a point touches or parts."""

    step: int
    share: float
    """of the step, before it"""
    stiffness: Array
    """mean over the step of what it is like, by (y, ẏ/ω), shape (rank, 2 rank)"""


def contact_jumps(period_map: PeriodMap, period: Period) -> list[ContactJump]:
    """Return where forces jump in a period.

    The moment of a jump moves by −δw/ẇ with the normal motion w: it changes the
    momentum like a stiffness of jump/|ẇ| that acts at that moment alone.
    """
    points, basis = period_map.problem.interface.points, period_map.sliders.basis
    moved, moving = period_map.points(period.displacement, period.velocity)
    found = []
    for step, point in np.argwhere(passes(points, moved)):
        if not sudden(points, point):
            continue
        ends, speeds = moved[step : step + 2, point], moving[step : step + 2, point]
        way = ends[1, 0] - ends[0, 0]
        share = float((points.gap[point] - ends[0, 0]) / way)
        velocity = (1.0 - share) * speeds[0] + share * speeds[1]
        if velocity[0] == 0.0:
            continue
        jump = contact_jump(points, int(point), velocity, BESIDE * abs(way))
        rows = basis[3 * point : 3 * point + 3]
        elastic = np.outer(rows.T @ jump, rows[0]) / (
            abs(velocity[0]) * period_map.length
        )
        made = np.hstack([elastic, np.zeros_like(elastic)])
        found.append(ContactJump(int(step), share, made))
    return found


def passes(points: ContactPoints, moved: Array) -> NDArray[np.bool_]:
    """Return in which steps points touch or part, shape (steps, points).

    ``moved`` are their displacements at the ends of steps, (steps + 1, points, 3).
    """
    closed = moved[:, :, 0] > points.gap
    found: NDArray[np.bool_] = closed[1:] != closed[:-1]
    found &= points.normal == ONE_SIDED
    return found
