"""A cell between two samples: the motion within, and what its ends see (§6.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.symmetry import Symmetry
from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import inner_kernel


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


@inner_kernel
def write_motion(
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
def share_out(
    point: int,
    work: Work,
    made: Samples,
    first: int,
    last: int,
    place: int,
    after: int,
    near: float,
    far: float,
    near_force: float,
    far_force: float,
    symmetry: Symmetry,
) -> None:
    """Add what is in ``work`` to both samples at the ends of a cell.

    ``near`` and ``far`` are the weights of the tangents, the others of the force.
    """
    wraps = place + 1 == made.forces.shape[1] // 2 and symmetry.signs.size > 0
    target = 0 if wraps else after
    for side in range(2):
        weight, forced, end = near, near_force, place
        if side == 1:
            weight, forced, end = far, far_force, target
        _deposit(
            point, work, made, first, last, end, weight, forced,
            wraps and side == 1, symmetry,
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
