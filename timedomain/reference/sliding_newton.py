"""Newton's method of a step with rigid contacts: accelerations and pushes (§7.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.memory import friction_load
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.rigid import slide
from microslip_mechanics.jit import kernel
from timedomain.contact.dense import combine, eliminate, norm
from timedomain.contact.operators import Operators
from timedomain.contact.reaction import react
from timedomain.contact.state import State
from timedomain.reference.newmark import HALVINGS, NEWTON_LIMIT
from timedomain.reference.rigid_points import Sliders

LOOSE = 1e-9
"""η: share of a push by which it is pinned where sticking leaves it free"""


class Trial(NamedTuple):
    """What Newton's method looks for, and what it made of it."""

    acceleration: Array
    """of y, shape (rank,)"""
    push: Array
    """on the mass of each contact [N], shape (2 count,)"""
    traction: Array
    """means over the step [N], shape (2 count,)"""
    residual: Array
    """[m/s²], shape (rank + 2 count,)"""
    matrix: Array
    slid: Array
    """traction and momentum of one point, shape (4,)"""
    by: Array
    """their derivatives, shape (4, 6)"""
    loads: Array
    """normal loads before the step [N], shape (count,)"""


@kernel
def solve_sliding(
    operators: Operators,
    sliders: Sliders,
    compliance: Array,
    points: ContactPoints,
    state: State,
    start: Array,
    tolerance: float,
    made: Trial,
) -> tuple[Array, int]:
    """Solve for the relative acceleration and the pushes of a step.

    ``start`` holds relative displacement, velocity and acceleration without contact
    forces, and the velocity before the step, shape ``(4, rank)``.

    Return the contact force on y without that of rigid friction, and the iterations,
    or −1. A change that does not lower the residual is halved.
    """
    rank = start.shape[1]
    guess: Array = start[2] - np.dot(operators.compliance, state.reaction)
    pushed = made.push.copy()
    change: Array = np.zeros(made.residual.size)
    scale, size = norm(start[2]) + TINY, np.inf
    smooth: Array = np.zeros(rank)
    for iteration in range(NEWTON_LIMIT + 1):
        shrink, reached = 1.0, np.inf
        for _ in range(HALVINGS):
            combine(guess, -shrink, change[:rank], made.acceleration)
            combine(pushed, -shrink, change[rank:], made.push)
            smooth = _assemble(
                operators, sliders, compliance, points, state, start, made
            )
            reached = norm(made.residual)
            if reached < size:
                break
            shrink *= 0.5
        if not reached < size:
            return smooth, -1
        guess, pushed, size = made.acceleration.copy(), made.push.copy(), reached
        if size <= tolerance * (scale + norm(guess)):
            return smooth, iteration
        change = made.residual.copy()
        if not eliminate(made.matrix, change):
            return smooth, -1
    return smooth, -1


@kernel
def _assemble(
    operators: Operators,
    sliders: Sliders,
    compliance: Array,
    points: ContactPoints,
    state: State,
    start: Array,
    made: Trial,
) -> Array:
    """Write tractions, residual and Newton's matrix; return the other contact force."""
    half, rank = 0.5 * operators.step, start.shape[1]
    tangent, smooth = np.empty((rank, rank)), np.empty(rank)
    react(
        operators,
        points,
        state,
        start[0] + half**2 * made.acceleration,
        start[1] + half * made.acceleration,
        smooth,
        tangent,
        np.zeros((5, 3, 3)),
    )
    matrix, residual = made.matrix, made.residual
    matrix[:] = 0.0
    for place in range(sliders.points.size):
        _slide(operators, sliders, points, state, start, place, compliance[place], made)
    reaction = smooth + 2.0 * np.dot(sliders.rows.T, made.traction)
    balance = made.acceleration - start[2] + np.dot(operators.compliance, reaction)
    for i in range(rank):
        residual[i] = balance[i]
        for j in range(rank):
            matrix[i, j] += tangent[i, j]
    np.dot(operators.compliance, matrix[:rank].copy(), matrix[:rank])
    faster = (start[1] - start[3]) / half + made.acceleration
    slid = np.dot(sliders.rows, faster)
    for i in range(rank):
        matrix[i, i] += 1.0
        for j in range(slid.size):
            matrix[rank + j, i] += sliders.rows[j, i]
    for j in range(slid.size):
        residual[rank + j] += slid[j]
    return smooth


@kernel
def _slide(
    operators: Operators,
    sliders: Sliders,
    points: ContactPoints,
    state: State,
    start: Array,
    place: int,
    compliance: float,
    made: Trial,
) -> None:
    """Write one point's traction, and its part of the residual and of the matrix."""
    half, rank = 0.5 * operators.step, made.acceleration.size
    point, one, two = sliders.points[place], 2 * place, 2 * place + 1
    load, stiff, viscous = friction_load(
        points, point, state.gaps[point, 0], state.slips[point, 0]
    )
    load = 0.5 * (made.loads[place] + load)
    slope = 0.5 * points.dynamic[point] * half * (half * stiff + viscous)
    momentum = np.dot(sliders.rows[one : two + 1], start[3])
    momentum /= max(2.0 * half * compliance, TINY)
    limit = points.dynamic[point] * load
    slide(made.push[one : two + 1], limit, 0.0, momentum, made.slid, made.by)
    share, by = 2.0 * compliance, made.by
    for axis in range(2):
        own = one + axis
        made.traction[own] = made.slid[axis]
        made.residual[rank + own] = share * (
            made.traction[own] - (1.0 + LOOSE) * made.push[own]
        )
        made.matrix[rank + own, rank + own] -= share * (1.0 + LOOSE)
        for other in range(2):
            made.matrix[rank + own, rank + one + other] += share * by[axis, other]
        for j in range(rank):
            deeper = slope * by[axis, 2] * sliders.normals[place, j]
            made.matrix[rank + own, j] += share * deeper
            for i in range(rank):
                made.matrix[i, j] += 2.0 * sliders.rows[own, i] * deeper
        for i in range(rank):
            for other in range(2):
                made.matrix[i, rank + one + other] += (
                    2.0 * sliders.rows[own, i] * by[axis, other]
                )
