"""Gauss rules between the transitions within a cell (theory §6.1)."""

from __future__ import annotations

import math

import numpy as np

from hbm.forces.cell import Samples, Work, share_out, write_motion
from hbm.forces.contact_jump import jump
from hbm.forces.symmetry import Symmetry
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge, sudden
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel, inner_kernel

GAUSS_PLACES = np.array([0.5 - math.sqrt(0.15), 0.5, 0.5 + math.sqrt(0.15)])
GAUSS_WEIGHTS = np.array([5.0, 8.0, 5.0]) / 18.0
_PLACES, _WEIGHTS = np.polynomial.legendre.leggauss(4)
GRADED_PLACES, GRADED_WEIGHTS = 0.5 + 0.5 * _PLACES, 0.5 * _WEIGHTS


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
    if sudden(points, point) and grade == 1:
        jump(
            points, point, displacement, velocity, work, made, first, last, place,
            after, symmetry,
        )  # fmt: skip
    touch, nodes = edge(points, point), 3 if grade == 1 else 4
    before = displacement[3 * point, place] - touch
    change = displacement[3 * point, after] - touch - before
    for piece in range(-2, nodes * (events.size - 1)):
        if piece < 0:
            # what the trapezoidal rule has put there is taken back
            share = piece + 2.0
            near, far, blur = -0.5 * (1.0 - share), -0.5 * share, 1.0 / 6.0
        else:
            share, weight = node(events, piece, nodes, before, change, grade)
            near, far, blur = weight * (1.0 - share), weight * share, 0.0
        near, far, blur = part * near, part * far, part * blur
        write_motion(point, displacement, velocity, place, after, share, work)
        contact_force(
            points, point, work.moved, work.moving, work.force,
            work.by_displacement, work.by_velocity,
        )  # fmt: skip
        tilt = blur * (1.0 - 2.0 * share)
        share_out(
            point, work, made, first, last, place, after, near, far, near + tilt,
            far - tilt, symmetry,
        )  # fmt: skip


@inner_kernel
def node(
    events: Array, piece: int, nodes: int, before: float, change: float, grade: int
) -> tuple[float, float]:
    """Return the share and the weight of a node, of ``nodes`` between two events.

    ``before`` is the penetration at the first sample, ``change`` what the second has
    more.
    """
    left, right = events[piece // nodes], events[piece // nodes + 1]
    if grade == 1:
        share = left + (right - left) * GAUSS_PLACES[piece % 3]
        weight = (right - left) * GAUSS_WEIGHTS[piece % 3]
    else:
        share, weight = _graded_node(
            left, right, -before / change, grade, piece % nodes
        )
    return share, weight


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
