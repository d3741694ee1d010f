"""Newton's matrix and residual for the contact forces of one stage (theory, §7.2)."""

from __future__ import annotations

from microslip_mechanics.jit import inner_kernel
from timedomain.contact.local_motion import Answer, Local
from timedomain.contact.point_law import linearise
from timedomain.fast.coordinates import Contacts


@inner_kernel
def assemble(
    contacts: Contacts, answer: Answer, local: Local, careful: bool
) -> tuple[float, float]:
    """Write Newton's matrix and right side; return the residual and its scale."""
    rank = local.velocity.size
    matrix, right = local.matrix, local.change[0]
    for i in range(rank):
        right[i] = local.reaction[i]
        for j in range(rank):
            matrix[i, j] = answer.stiffness[i, j]
    scale = 0.0
    for point in range(contacts.first.size):
        linearise(
            contacts.points,
            point,
            answer.weight[point],
            careful,
            answer.begins,
            local.gaps,
            local.slips,
            local.forces,
            local.lines,
            local.by_gap,
            local.by_slip,
        )
        line = local.lines[point]
        scale = max(scale, abs(line[0]) + abs(line[1]) + abs(line[2]))
        for axis in range(3):
            local.by_slip[point, axis, 0] += answer.slope * local.by_gap[point, axis]
        _scatter(contacts, local, point)
    size = 0.0
    for i in range(rank):
        size = max(size, abs(right[i]))
        scale = max(scale, abs(local.reaction[i]))
    return size, scale


@inner_kernel
def _scatter(contacts: Contacts, local: Local, point: int) -> None:
    """Add one point to Newton's matrix and right side."""
    first, width = contacts.first[point], contacts.width[point]
    basis, lines, slopes = contacts.basis, local.lines, local.by_slip
    for i in range(width):
        up, one, two = basis[point, 0, i], basis[point, 1, i], basis[point, 2, i]
        local.change[0, first + i] -= (
            up * lines[point, 0] + one * lines[point, 1] + two * lines[point, 2]
        )
        zero = up * slopes[point, 0, 0]
        zero += one * slopes[point, 1, 0] + two * slopes[point, 2, 0]
        left = one * slopes[point, 1, 1] + two * slopes[point, 2, 1]
        side = one * slopes[point, 1, 2] + two * slopes[point, 2, 2]
        for j in range(width):
            local.matrix[first + i, first + j] += (
                zero * basis[point, 0, j]
                + left * basis[point, 1, j]
                + side * basis[point, 2, j]
            )
