"""Contact forces on the relative coordinates, with their derivative, compiled."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import add_traction
from microslip_mechanics.contact.points import ELASTIC, RIGID, ContactPoints
from microslip_mechanics.contact.spread import spread_force
from microslip_mechanics.jit import bare_kernel
from timedomain.contact.dense import dot
from timedomain.contact.operators import Operators
from timedomain.contact.state import State


@bare_kernel
def react(
    operators: Operators,
    points: ContactPoints,
    state: State,
    displacement: Array,
    velocity: Array,
    reaction: Array,
    tangent: Array,
    tangents: Array,
) -> None:
    """Write the contact force on y, and its derivative by the acceleration.

    ``tangents``, shape ``(5, 3, 3)``, is work.
    """
    basis = operators.basis
    reaction[:] = 0.0
    tangent[:] = 0.0
    for point in range(points.load.size):
        rows = basis[3 * point : 3 * point + 3]
        for axis in range(3):
            state.gaps[point, axis] = dot(rows[axis], displacement)
            state.slips[point, axis] = dot(rows[axis], velocity)
        spread_force(
            points,
            point,
            operators.step,
            state.gaps[point],
            state.slips[point],
            state.forces[point],
            tangents,
        )
        if ELASTIC <= points.friction[point] < RIGID:
            add_traction(
                points, point, state.gaps[point], state.slips[point],
                state.past[point], state.fresh[point], state.forces[point],
                tangents[0], tangents[1],
            )  # fmt: skip
        _scatter(operators.step, rows, state.forces[point], tangents, reaction, tangent)


@bare_kernel
def _scatter(
    step: float,
    rows: Array,
    force: Array,
    tangents: Array,
    reaction: Array,
    tangent: Array,
) -> None:
    """Add one point's force and tangent to those of the relative coordinates."""
    rank = reaction.size
    for axis in range(3):
        for i in range(rank):
            reaction[i] += rows[axis, i] * force[axis]
        for other in range(3):
            slope = 0.5 * step * tangents[1, axis, other]
            slope += 0.25 * step**2 * tangents[0, axis, other]
            if slope == 0.0:
                continue
            for i in range(rank):
                left = rows[axis, i] * slope
                if left != 0.0:
                    for j in range(rank):
                        tangent[i, j] += left * rows[other, j]
