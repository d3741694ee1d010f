"""Contact forces at the samples of a period, transitions resolved between them.

Regularised friction turns around within a layer of phase width V_lim/(ω v_max), far
narrower than the distance of samples. In a cell between two samples through which such
a transition goes, the motion is interpolated linearly, the events are located, and a
Gauss rule between them takes the place of the trapezoidal rule (theory §6).
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import (
    FRICTIONLESS,
    GENERAL_KINETIC,
    ContactPoints,
    contact_force,
)
from microslip_mechanics.jit import kernel

GAUSS_PLACES = np.array([0.5 - math.sqrt(0.15), 0.5, 0.5 + math.sqrt(0.15)])
GAUSS_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0
FADING = 3.0
"""Stribeck speeds past the threshold at which an event is placed as well"""
EVENTS = 10
"""most within a cell: two crossings of each of four speeds, one turn, one touch"""


class Symmetry(NamedTuple):
    """What half a period later looks like; empty arrays without that symmetry."""

    partners: NDArray[np.int64]
    """row of the points that moves like this one did half a period before"""
    signs: Array
    """but for this sign; shape (3 points,) or (0,)"""
    entry_partners: NDArray[np.int64]
    """the same for the tangents, shape (entries,) or (0,)"""
    entry_signs: Array


class Forces(NamedTuple):
    """Where forces are written; the last axis is the sample."""

    force: Array
    """[N], shape (3 points, samples)"""
    change: Array
    """(∂force/∂velocity) velocity [N]"""


class Samples(NamedTuple):
    """Where forces and tangents are written; the last axis is the sample."""

    forces: Array
    changes: Array
    """(∂force/∂velocity) velocity"""
    tangents: Array
    entries: NDArray[np.int64]
    """(row, column, by velocity) of each tangent"""


class Work(NamedTuple):
    """Scratch of one contact evaluation."""

    moved: Array
    moving: Array
    force: Array
    by_displacement: Array
    by_velocity: Array


@kernel
def sample(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    entries: NDArray[np.int64],
    symmetry: Symmetry,
    regular: Forces,
    extra: Forces,
    tangents: Array,
) -> bool:
    """Write forces, (∂force/∂velocity) velocity, and chosen tangents at all samples.

    Parameters
    ----------
    points
        Contact table.
    displacement, velocity
        Of the points at the samples, shape ``(3 points, samples)``; with a symmetry
        the first half of the period and one more sample is enough.
    entries
        (row, column, by velocity) of each tangent, ordered by points.
    symmetry
        Of half a period.
    regular
        Written: what the samples see, the last axis with all samples.
    extra
        Written: what cells with events add to it, for :func:`hat`.
    tangents
        Written, both together.

    Returns
    -------
    Whether there is an event.
    """
    samples = tangents.shape[1]
    seen = samples // 2 if symmetry.signs.size else samples
    bounds = np.searchsorted(
        entries[:, 0], 3 * np.arange(points.load.size + 1, dtype=np.int64)
    )
    for point in range(points.load.size):
        _regular(
            points, point, displacement, velocity, entries, bounds[point],
            bounds[point + 1], seen, regular.force, regular.change, tangents,
        )  # fmt: skip
    made = Samples(extra.force, extra.change, tangents, entries)
    extra.force[:, :seen] = 0.0
    extra.change[:, :seen] = 0.0
    eventful = False
    work = Work(
        np.zeros(3), np.zeros(3), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    )
    events = np.zeros(EVENTS + 2)
    for point in range(points.load.size):
        threshold = points.threshold[point]
        wide = threshold
        if points.friction[point] == GENERAL_KINETIC:
            wide += FADING * points.stribeck[point]
        rubs = points.friction[point] != FRICTIONLESS
        row = 3 * point
        for place in range(seen):
            after = place + 1 if place + 1 < displacement.shape[1] else 0
            if _passes(
                displacement, velocity, row, place, after, rubs, threshold, wide
            ):
                found = _events(
                    points, point, displacement, velocity, place, after, events
                )
                if found > 0:
                    eventful = True
                    _refine(
                        points, point, displacement, velocity, work, made,
                        bounds[point], bounds[point + 1], place, after,
                        events[: found + 2], symmetry,
                    )  # fmt: skip
    for forces in (regular, extra):
        mirror(forces.force, symmetry.partners, symmetry.signs)
        mirror(forces.change, symmetry.partners, symmetry.signs)
    mirror(tangents, symmetry.entry_partners, symmetry.entry_signs)
    return eventful


def hat(harmonics: int, samples: int) -> Array:
    """Return what linear sharing between samples makes of each order, (2 H + 1,).

    The trapezoidal rule of a linear function, shared out as the nodes of a cell with
    events are, would be multiplied by it. Dividing the extra forces by it keeps the
    coefficients continuous when an event passes a sample.
    """
    orders = (np.arange(2 * harmonics + 1) + 1) // 2
    factor: Array = (2.0 + np.cos(2.0 * np.pi * orders / samples)) / 3.0
    return factor


@kernel
def mirror(rows: Array, partners: NDArray[np.int64], signs: Array) -> None:
    """Fill the second half of a period from the first, if there is a symmetry."""
    half = rows.shape[1] // 2
    if signs.size:
        for row in range(rows.shape[0]):
            for place in range(half):
                rows[row, half + place] = signs[row] * rows[partners[row], place]


@kernel
def _regular(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    entries: NDArray[np.int64],
    first: int,
    last: int,
    seen: int,
    forces: Array,
    changes: Array,
    tangents: Array,
) -> None:
    """Write force and tangents of one point at each sample."""
    moved, moving, force = np.zeros(3), np.zeros(3), np.zeros(3)
    stiff, slope = np.zeros((3, 3)), np.zeros((3, 3))
    row = 3 * point
    for place in range(seen):
        for axis in range(3):
            moved[axis] = displacement[row + axis, place]
            moving[axis] = velocity[row + axis, place]
        contact_force(points, point, moved, moving, force, stiff, slope)
        for axis in range(3):
            forces[row + axis, place] = force[axis]
            changes[row + axis, place] = (
                slope[axis, 0] * moving[0]
                + slope[axis, 1] * moving[1]
                + slope[axis, 2] * moving[2]
            )
        for entry in range(first, last):
            at, by = entries[entry, 0] - row, entries[entry, 1] - row
            if entries[entry, 2] == 0:
                tangents[entry, place] = stiff[at, by]
            else:
                tangents[entry, place] = slope[at, by]


@kernel
def _passes(
    displacement: Array,
    velocity: Array,
    row: int,
    place: int,
    after: int,
    rubs: bool,
    threshold: float,
    wide: float,
) -> bool:
    """Return whether contact, or slow sliding, begins, ends or is passed in a cell."""
    if (displacement[row, place] > 0.0) != (displacement[row, after] > 0.0):
        return True
    if not rubs:
        return False
    one, two = velocity[row + 1, place], velocity[row + 2, place]
    next_one, next_two = velocity[row + 1, after], velocity[row + 2, after]
    square, next_square = one * one + two * two, next_one**2 + next_two**2
    turns = one * next_one + two * next_two < 0.0
    for speed in (threshold, wide):
        slow, next_slow = square <= speed * speed, next_square <= speed * speed
        if slow != next_slow or (turns and not slow):
            return True
    return False


@kernel
def _deposit(
    point: int,
    work: Work,
    made: Samples,
    first: int,
    last: int,
    place: int,
    weight: float,
    forced: float,
    wraps: bool,
    symmetry: Symmetry,
) -> None:
    """Add tangents in ``work``, weighted, and its force, weighted by ``forced``.

    ``wraps`` says that it is the first of the next half: the first of this half then
    takes it, as half a period before.
    """
    moving, slope = work.moving, work.by_velocity
    for axis in range(3):
        row, share = 3 * point + axis, forced
        if wraps:
            share = forced * symmetry.signs[row]
            row = symmetry.partners[row]
        made.forces[row, place] += share * work.force[axis]
        made.changes[row, place] += share * (
            slope[axis, 0] * moving[0]
            + slope[axis, 1] * moving[1]
            + slope[axis, 2] * moving[2]
        )
    for entry in range(first, last):
        row = made.entries[entry, 0] - 3 * point
        column = made.entries[entry, 1] - 3 * point
        target, share = entry, weight
        if wraps:
            share = weight * symmetry.entry_signs[entry]
            target = symmetry.entry_partners[entry]
        if made.entries[entry, 2] == 0:
            made.tangents[target, place] += share * work.by_displacement[row, column]
        else:
            made.tangents[target, place] += share * slope[row, column]


@kernel
def _refine(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    work: Work,
    made: Samples,
    first: int,
    last: int,
    place: int,
    after: int,
    events: Array,
    symmetry: Symmetry,
) -> None:
    """Replace the trapezoidal rule in one cell by Gauss rules between its events.

    What a node sees is shared out to the two samples as a linear function would be.
    """
    wraps = place + 1 == made.forces.shape[1] // 2 and symmetry.signs.size > 0
    target = 0 if wraps else after
    for piece in range(-2, 3 * (events.size - 1)):
        if piece < 0:
            # what the trapezoidal rule has put there is taken back
            share = piece + 2.0
            near, far = -0.5 * (1.0 - share), -0.5 * share
            blur = 1.0 / 6.0
        else:
            left, right = events[piece // 3], events[piece // 3 + 1]
            share = left + (right - left) * GAUSS_PLACES[piece % 3]
            weight = (right - left) * GAUSS_WEIGHTS[piece % 3]
            near, far, blur = weight * (1.0 - share), weight * share, 0.0
        for axis in range(3):
            row = 3 * point + axis
            work.moved[axis] = (1.0 - share) * displacement[row, place] + (
                share * displacement[row, after]
            )
            work.moving[axis] = (1.0 - share) * velocity[row, place] + (
                share * velocity[row, after]
            )
        contact_force(
            points, point, work.moved, work.moving, work.force,
            work.by_displacement, work.by_velocity,
        )  # fmt: skip
        _deposit(
            point, work, made, first, last, place, near,
            near + blur * (1.0 - 2.0 * share), False, symmetry,
        )  # fmt: skip
        _deposit(
            point, work, made, first, last, target, far,
            far - blur * (1.0 - 2.0 * share), wraps, symmetry,
        )  # fmt: skip


@kernel
def _events(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    after: int,
    events: Array,
) -> int:
    """Write the places of events within a cell, from 0 to 1; return their number."""
    row = 3 * point
    before, behind = displacement[row, place], displacement[row, after]
    touched = before > 0.0 or behind > 0.0 or points.constant_load[point]
    if points.friction[point] == FRICTIONLESS and (before > 0.0) == (behind > 0.0):
        return 0
    found = 0
    if points.friction[point] != FRICTIONLESS and touched:
        wide = 0.0
        if points.friction[point] == GENERAL_KINETIC:
            wide = points.threshold[point] + FADING * points.stribeck[point]
        found = _slow(
            velocity[row + 1 : row + 3, place],
            velocity[row + 1 : row + 3, after],
            points.threshold[point],
            wide,
            events,
        )
    if (before > 0.0) != (behind > 0.0):
        found += 1
        events[found] = before / (before - behind)
    if found == 0:
        return 0
    events[0], events[found + 1] = 0.0, 1.0
    events[1 : found + 1].sort()
    return found


@kernel
def _slow(
    first: Array, last: Array, threshold: float, wide: float, events: Array
) -> int:
    """Write where sliding passes a threshold or turns; return the number of places.

    ``first`` and ``last`` are the sliding velocities at the two samples, (2,) each.
    """
    one, two = first
    by_one, by_two = last[0] - one, last[1] - two
    found = _crossings(one, two, by_one, by_two, threshold, events, 0)
    if wide > 0.0:
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


@kernel
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
