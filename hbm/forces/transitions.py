"""Places within a cell where a contact changes its state (theory §6.1).

Between two samples the motion is taken as linear in time. Faces that touch or separate,
sliding that passes the threshold and sliding that turns are events then, whose places
follow from linear and quadratic equations.
"""

from __future__ import annotations

import math

from hbm.forces.release import lets_go, released
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import edge, regularised
from microslip_mechanics.contact.points import GENERAL_KINETIC, ContactPoints
from microslip_mechanics.jit import bare_kernel, inner_kernel, kernel

EVENTS = 11
"""most within a cell: two crossings of each of four speeds, one turn, one touch, one
release"""
FADING = 3.0
"""Stribeck speeds past the threshold at which an event is placed as well"""


@bare_kernel
def faded(points: ContactPoints, point: int) -> float:
    """Return the speed at which friction has fallen, the threshold if it does not."""
    speed: float = points.threshold[point]
    if points.friction[point] == GENERAL_KINETIC:
        speed += FADING * points.stribeck[point]
    return speed


@bare_kernel
def passes(
    displacement: Array,
    velocity: Array,
    row: int,
    place: int,
    after: int,
    touch: float,
    slides: bool,
    threshold: float,
    wide: float,
) -> bool:
    """Return whether contact, or slow sliding, begins, ends or is passed in a cell.

    It keeps the many cells without events cheap; :func:`locate` is for the others.
    """
    if (displacement[row, place] > touch) != (displacement[row, after] > touch):
        return True
    if not slides:
        return False
    one, two = velocity[row + 1, place], velocity[row + 2, place]
    next_one, next_two = velocity[row + 1, after], velocity[row + 2, after]
    square, next_square = one * one + two * two, next_one**2 + next_two**2
    turns = one * next_one + two * next_two < 0.0
    for speed in (threshold, wide):
        slow, next_slow = square <= speed**2, next_square <= speed**2
        if slow != next_slow or (turns and not slow):
            return True
    return False


@kernel
def locate(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    after: int,
    events: Array,
) -> int:
    """Write the places of events within a cell, from 0 to 1; return their number.

    Parameters
    ----------
    points, point
        Contact table, and the row looked at.
    displacement, velocity
        Of the points at the samples, shape ``(3 points, samples)``.
    place, after
        The samples at the cell's ends.
    events
        Written: 0, the events in rising order, and 1; shape ``(EVENTS + 2,)``.
    """
    row = 3 * point
    touch = edge(points, point)
    before, behind = displacement[row, place] - touch, displacement[row, after] - touch
    pressed = before > 0.0 or behind > 0.0 or points.constant_load[point]
    found = 0
    if pressed and regularised(points, point):
        one, two = velocity[row + 1, place], velocity[row + 2, place]
        by_one, by_two = velocity[row + 1, after] - one, velocity[row + 2, after] - two
        threshold, wide = points.threshold[point], faded(points, point)
        found = _slow(one, two, by_one, by_two, threshold, wide, events)
    if (before > 0.0) != (behind > 0.0):
        found += 1
        events[found] = before / (before - behind)
    if lets_go(points, point):
        share = released(points, point, displacement, velocity, place, after)
        if share > 0.0:
            found += 1
            events[found] = share
    events[0], events[found + 1] = 0.0, 1.0
    _rise(events, found)
    return found


@inner_kernel
def _rise(events: Array, found: int) -> None:
    """Bring the few events after the first place into rising order."""
    for last in range(2, found + 1):
        event, place = events[last], last
        while place > 1 and events[place - 1] > event:
            events[place] = events[place - 1]
            place -= 1
        events[place] = event


@inner_kernel
def _slow(
    one: float,
    two: float,
    by_one: float,
    by_two: float,
    threshold: float,
    wide: float,
    events: Array,
) -> int:
    """Write where sliding passes a threshold or turns; return the number of places.

    ``one`` and ``two`` are the sliding velocity at the first sample, ``by_one`` and
    ``by_two`` what the second has more.
    """
    found = int(0.0)  # kernels are compiled anew for a literal
    found = _crossings(one, two, by_one, by_two, threshold, events, found)
    if wide > threshold:
        found = _crossings(one, two, by_one, by_two, wide, events, found)
    square = by_one * by_one + by_two * by_two
    if square == 0.0:
        return found
    middle = -(one * by_one + two * by_two) / square
    if 0.0 < middle < 1.0:
        found += 1
        events[found] = middle
        slowest = math.hypot(one + middle * by_one, two + middle * by_two)
        for times in (2.0, 8.0):
            speed = times * max(slowest, threshold)
            found = _crossings(one, two, by_one, by_two, speed, events, found)
    return found


@inner_kernel
def _crossings(
    one: float,
    two: float,
    by_one: float,
    by_two: float,
    speed: float,
    events: Array,
    found: int,
) -> int:
    """Add where the velocity, linear between two samples, has a given speed."""
    square = by_one * by_one + by_two * by_two
    if square == 0.0:
        return found
    middle = -(one * by_one + two * by_two) / square
    # The least speed on the way, from a cross product: a difference of squares would
    # lose a threshold that is 1e-8 of the speeds at the samples.
    least = one * by_two - two * by_one
    inside = (speed * speed - least * least / square) / square
    if inside <= 0.0:
        return found
    root = math.sqrt(inside)
    for place in (middle - root, middle + root):
        if 0.0 < place < 1.0:
            found += 1
            events[found] = place
    return found
