"""Cells of a period in which faces touch or part, and their tangents (theory §6.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.cell import Work, write_motion
from hbm.forces.refinement import node
from hbm.forces.steep_edge import steepness
from hbm.forces.transitions import EVENTS, locate
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge
from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from microslip_mechanics.jit import inner_kernel, kernel


class Touches(NamedTuple):
    """Cells in which a point touches or lifts off."""

    point: NDArray[np.int64]
    """shape (cells,)"""
    place: NDArray[np.int64]
    """the sample before, shape (cells,)"""
    shared: Array
    """∂force/∂displacement and ∂force/∂velocity, of the force on either end by the
    motion of either end; shape ``(cells, 2, 2 forces, 2 motions, 3, 3)``"""


def touches(
    points: ContactPoints, displacement: Array, velocity: Array, seen: int
) -> Touches:
    """Return the cells in which a point touches or lifts off, of the first ``seen``.

    ``displacement`` and ``velocity`` are those of the points at the samples, shape
    ``(3 points, samples)``.
    """
    point, place = _cells(points, displacement, seen)
    shared = np.zeros((point.size, 2, 2, 2, 3, 3))
    _share(points, displacement, velocity, point, place, shared)
    return Touches(point, place, shared)


@kernel
def _cells(
    points: ContactPoints, displacement: Array, seen: int
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return points and samples of these cells."""
    room = points.load.size * seen
    found = np.empty((2, room), dtype=np.int64)
    count = int(0.0)  # kernels are compiled anew for a literal
    for point in range(points.load.size):
        for place in range(seen):
            if _touches(points, point, displacement, place):
                found[0, count], found[1, count] = point, place
                count += 1
    return found[0, :count].copy(), found[1, :count].copy()


@kernel
def _share(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    point: NDArray[np.int64],
    place: NDArray[np.int64],
    shared: Array,
) -> None:
    """Write what :class:`Touches` has of the cells."""
    events = np.zeros(EVENTS + 2)
    work = Work(
        np.zeros(3), np.zeros(3), np.zeros(3), np.zeros((3, 3)), np.zeros((3, 3))
    )
    for cell in range(point.size):
        _fill(
            points, point[cell], displacement, velocity, place[cell], work, events,
            shared[cell],
        )  # fmt: skip


@inner_kernel
def _after(displacement: Array, place: int) -> int:
    """Return the sample at the other end of a cell."""
    return place + 1 if place + 1 < displacement.shape[1] else 0


@inner_kernel
def _touches(
    points: ContactPoints, point: int, displacement: Array, place: int
) -> bool:
    """Return whether a point touches or lifts off in a cell, but for steep edges."""
    if points.normal[point] != ONE_SIDED or steepness(points, point) > 1:
        return False
    row, touch = 3 * point, edge(points, point)
    after = _after(displacement, place)
    return bool(
        (displacement[row, place] > touch) != (displacement[row, after] > touch)
    )


@inner_kernel
def _fill(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    work: Work,
    events: Array,
    shared: Array,
) -> None:
    """Add up the tangents of a cell, as :mod:`~hbm.forces.refinement` its forces."""
    after = _after(displacement, place)
    found = locate(points, point, displacement, velocity, place, after, events)
    for piece in range(-2, 3 * (found + 1)):
        share, weight = piece + 2.0, 0.0
        if piece >= 0:
            share, weight = node(events[: found + 2], piece, 3, 0.0, 1.0, 1)
        write_motion(point, displacement, velocity, place, after, share, work)
        contact_force(
            points, point, work.moved, work.moving, work.force,
            work.by_displacement, work.by_velocity,
        )  # fmt: skip
        for end in range(2):
            for by in range(2):
                near, sees = abs(1.0 - end - share), abs(1.0 - by - share)
                part = weight * near * sees
                if piece < 0:
                    # the trapezoidal rule is taken back
                    part = -(1.0 + near) / 6.0 * sees
                for row in range(3):
                    for column in range(3):
                        tangent = work.by_displacement[row, column]
                        shared[0, end, by, row, column] += part * tangent
                        tangent = work.by_velocity[row, column]
                        shared[1, end, by, row, column] += part * tangent
