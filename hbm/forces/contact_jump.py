"""The tangent of a force that jumps where contact begins or ends (theory §8)."""

from __future__ import annotations

from hbm.forces.cell import Samples, Work, share_out, write_motion
from hbm.forces.symmetry import Symmetry
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import inner_kernel

BESIDE = 1e-9
"""of a cell's way: how far from the edge both sides of a jump are looked at"""


@inner_kernel
def jump(
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
    write_motion(point, displacement, velocity, place, after, share, work)
    _write_jump(points, point, touch, way, work)
    share_out(
        point, work, made, first, last, place, after, 1.0 - share, share, 0.0, 0.0,
        symmetry,
    )  # fmt: skip


@inner_kernel
def _write_jump(
    points: ContactPoints, point: int, touch: float, way: float, work: Work
) -> None:
    """Write the jump at the edge over ``way`` as a tangent by the normal motion."""
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
