"""Gauss rules between the transitions within a cell (theory §6)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.symmetry import Symmetry
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel, inner_kernel

GAUSS_PLACES = np.array([0.5 - math.sqrt(0.15), 0.5, 0.5 + math.sqrt(0.15)])
GAUSS_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(4)
GRADED_PLACES, GRADED_WEIGHTS = 0.5 + 0.5 * _PLACES, 0.5 * _WEIGHTS
BESIDE = 1e-9
"""of a cell's way: how far from the edge both sides of a jump are looked at"""


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


@bare_kernel
def refine(
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
    grade: int,
    part: float,
    symmetry: Symmetry,
) -> None:
    """Replace the trapezoidal rule in one cell by Gauss rules between its events.

    What a node sees is shared out to the two samples as a linear function would be. A
    force that jumps as the faces touch has a tangent there alone. Nodes are
    graded towards the edge by a root of order ``grade``; ``part`` is the part of the
    rule that is replaced.
    """
    if points.damping[point] != 0.0 and grade == 1:
        _jump(
            points, point, displacement, velocity, work, made, first, last, place,
            after, symmetry,
        )  # fmt: skip
    wraps = place + 1 == made.forces.shape[1] // 2 and symmetry.signs.size > 0
    target = 0 if wraps else after
    touch, nodes = edge(points, point), 3 if grade == 1 else 4
    before = displacement[3 * point, place] - touch
    change = displacement[3 * point, after] - touch - before
    for piece in range(-2, nodes * (events.size - 1)):
        if piece < 0:
            # what the trapezoidal rule has put there is taken back
            share = piece + 2.0
            near, far = -0.5 * (1.0 - share), -0.5 * share
            blur = 1.0 / 6.0
        else:
            left, right = events[piece // nodes], events[piece // nodes + 1]
            if grade == 1:
                share = left + (right - left) * GAUSS_PLACES[piece % 3]
                weight = (right - left) * GAUSS_WEIGHTS[piece % 3]
            else:
                share, weight = _graded_node(
                    left, right, -before / change, grade, piece % nodes
                )
            near, far, blur = weight * (1.0 - share), weight * share, 0.0
        near, far, blur = part * near, part * far, part * blur
        _write_motion(point, displacement, velocity, place, after, share, work)
        contact_force(
            points, point, work.moved, work.moving, work.force,
            work.by_displacement, work.by_velocity,
        )  # fmt: skip
        for side in range(2):
            weight, end = (near, place) if side == 0 else (far, target)
            tilt = (1.0 - 2.0 * side) * blur * (1.0 - 2.0 * share)
            _deposit(
                point, work, made, first, last, end, weight, weight + tilt,
                wraps and side == 1, symmetry,
            )  # fmt: skip


@inner_kernel
def _write_motion(
    point: int,
    displacement: Array,
    velocity: Array,
    place: int,
    after: int,
    share: float,
    work: Work,
) -> None:
    """Write the motion of a point between two samples, linear between them."""
    for axis in range(3):
        row = 3 * point + axis
        work.moved[axis] = (1.0 - share) * displacement[row, place] + (
            share * displacement[row, after]
        )
        work.moving[axis] = (1.0 - share) * velocity[row, place] + (
            share * velocity[row, after]
        )


@inner_kernel
def _graded_node(
    left: float, right: float, touch: float, grade: int, node: int
) -> tuple[float, float]:
    """Return the share and the weight of a Gauss node between two events.

    Gauss's rule is that of the root, of order ``grade``, of the distance to where the
    faces ``touch``, in or beside the cell.
    """
    power = 1.0 / grade
    near, far = abs(left - touch) ** power, abs(right - touch) ** power
    root = near + (far - near) * GRADED_PLACES[node]
    way = 1.0 if left + right > 2.0 * touch else -1.0
    weight = way * (far - near) * GRADED_WEIGHTS[node] * grade * root ** (grade - 1)
    return touch + way * root**grade, weight


@inner_kernel
def _jump(
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
    symmetry: Symmetry,
) -> None:
    """Add the tangent of a force that jumps where contact begins or ends in a cell.

    The place of the jump moves by −δw/w′ with the normal motion w: its integral is that
    of a tangent by displacement of the jump over |w′|, at that place alone.
    """
    row, touch = 3 * point, edge(points, point)
    before, behind = displacement[row, place] - touch, displacement[row, after] - touch
    if (before > 0.0) == (behind > 0.0):
        return
    share, way = before / (before - behind), abs(behind - before)
    _write_motion(point, displacement, velocity, place, after, share, work)
    work.moved[0] = touch - BESIDE * way
    contact_force(
        points, point, work.moved, work.moving, work.force,
        work.by_displacement, work.by_velocity,
    )  # fmt: skip
    apart, one, two = work.force[0], work.force[1], work.force[2]
    work.moved[0] = touch + BESIDE * way
    contact_force(
        points, point, work.moved, work.moving, work.force,
        work.by_displacement, work.by_velocity,
    )  # fmt: skip
    work.by_displacement[:] = 0.0
    work.by_velocity[:] = 0.0
    work.by_displacement[0, 0] = (work.force[0] - apart) / way
    work.by_displacement[1, 0] = (work.force[1] - one) / way
    work.by_displacement[2, 0] = (work.force[2] - two) / way
    wraps = place + 1 == made.forces.shape[1] // 2 and symmetry.signs.size > 0
    for side in range(2):
        weight, end = (1.0 - share, place) if side == 0 else (share, after)
        wraps_there = wraps and side == 1
        _deposit(
            point, work, made, first, last, 0 if wraps_there else end, weight, 0.0,
            wraps_there, symmetry,
        )  # fmt: skip


@inner_kernel
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
