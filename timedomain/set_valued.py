"""Average acceleration with rigid friction as a set-valued law (theory §7).

A rigid contact carries a mean traction over a step: that under which the mass that it
sees, with a constant push, slides from its velocity at the step's begin to that at its
end, stopping in between where it would turn. A contact that sticks ends with no sliding
velocity at all. Impulses stay out of the acceleration that the next step begins with,
so that a contact that begins to stick does not ring.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import friction_load
from microslip_mechanics.contact.points import RIGID, ContactPoints
from microslip_mechanics.contact.rigid import slide
from microslip_mechanics.jit import kernel
from microslip_mechanics.problem import Problem
from timedomain.dense import solve_in_place
from timedomain.newmark import HALVINGS, NEWTON_LIMIT
from timedomain.operators import Operators
from timedomain.reaction import reaction_of
from timedomain.record import FLOWS, Meters, accumulate, store
from timedomain.state import State

FRICTION = FLOWS.index("friction")
LOOSE = 1e-9
"""η: share of a push by which it is pinned where sticking leaves it free"""


class Sliders(NamedTuple):
    """The rigid points of a problem, each with both tangents."""

    points: NDArray[np.int64]
    """shape (count,)"""
    rows: Array
    """sliding displacements from y, shape (2 count, rank)"""
    normals: Array
    """penetrations from y, shape (count, rank)"""
    release: Array
    """acceleration from forces on y, M⁻¹ Lᵀ, shape (dofs, rank)"""


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


def sliders(problem: Problem) -> Sliders:
    """Return the rigid points of a problem."""
    basis, selection = problem.interface.relative_motion()
    points = np.flatnonzero(problem.interface.points.friction == RIGID)
    tangents = (3 * points[:, None] + np.array([1, 2])).ravel()
    mass = problem.structure.dense.mass
    return Sliders(
        points,
        np.ascontiguousarray(basis[tangents]),
        np.ascontiguousarray(basis[3 * points]),
        np.linalg.solve(mass, selection.T),
    )


@kernel
def march_sliders(
    operators: Operators,
    sliders: Sliders,
    points: ContactPoints,
    state: State,
    meters: Meters,
    factors: Array,
    rows: Array,
    first: int,
    tolerance: float,
) -> tuple[int, int]:
    """March like :func:`timedomain.newmark.march`, with rigid points."""
    steps, stride = factors.shape[0], factors.shape[0] // rows.shape[0]
    compliance = _compliance(operators, sliders)
    count, rank = sliders.rows.shape
    size, iterations = rank + count, 0
    made = Trial(
        np.zeros(rank), np.zeros(count), np.zeros(count), np.zeros(size),
        np.zeros((size, size)), np.zeros(4), np.zeros((4, 6)), np.zeros(count // 2),
    )  # fmt: skip
    for place in range(count):
        made.push[place] = state.forces[sliders.points[place // 2], 1 + place % 2]
    for step in range(first, steps):
        gaps, slips, forces = state.gaps.copy(), state.slips.copy(), state.forces.copy()
        for place in range(count // 2):
            point = sliders.points[place]
            made.loads[place], _, _ = friction_load(
                points, point, state.gaps[point, 0], state.slips[point, 0]
            )
        taken = _advance(
            operators, sliders, compliance, points, state, factors[step], tolerance,
            made,
        )  # fmt: skip
        if taken < 0:  # its parts, too, begin where the step before has ended
            state.gaps[:], state.slips[:], state.forces[:] = gaps, slips, forces
            return step, iterations
        iterations += taken
        accumulate(meters, points, state, factors[step], operators.step)
        for point in sliders.points:  # the mean traction works on the mean velocity
            changed = state.forces[point, 1:] - forces[point, 1:]
            work = 0.5 * operators.step * np.dot(changed, slips[point, 1:])
            meters.energies[FRICTION] += work
        if (step + 1) % stride == 0:
            store(meters, points, state, rows[step // stride])
    return steps, iterations


@kernel
def _compliance(operators: Operators, sliders: Sliders) -> Array:
    """Return the larger acceleration of each point's tangents by force, (count,)."""
    count = sliders.points.size
    compliance = np.zeros(count)
    for place in range(2 * count):
        row = sliders.rows[place]
        own = np.dot(row, np.dot(operators.compliance, row))
        compliance[place // 2] = max(compliance[place // 2], own)
    return compliance


@kernel
def _advance(
    operators: Operators,
    sliders: Sliders,
    compliance: Array,
    points: ContactPoints,
    state: State,
    factors: Array,
    tolerance: float,
    made: Trial,
) -> int:
    """Take one step; return Newton's iterations, or −1 and an untouched motion."""
    half, dofs = 0.5 * operators.step, state.displacement.size
    predicted = np.empty(2 * dofs)
    for i in range(dofs):
        velocity = state.velocity[i] + half * state.acceleration[i]
        predicted[i] = state.displacement[i] + half * (state.velocity[i] + velocity)
        predicted[dofs + i] = velocity
    free = np.dot(operators.free, predicted) + np.dot(operators.load, factors)
    start = np.stack(
        (
            np.dot(operators.selection, predicted[:dofs]),
            np.dot(operators.selection, predicted[dofs:]),
            np.dot(operators.selection, free),
            np.dot(operators.selection, state.velocity),
        )
    )
    smooth, taken = _newton(
        operators, sliders, compliance, points, state, start, tolerance, made
    )
    if taken < 0:  # once more, as if nothing rubbed before
        made.push[:] = 0.0
        smooth, taken = _newton(
            operators, sliders, compliance, points, state, start, tolerance, made
        )
    if taken < 0:
        return taken
    # twice the mean at the end and nothing at the beginning: the trapezoidal rule
    impulse = 2.0 * np.dot(sliders.rows.T, made.traction)
    free -= np.dot(operators.contact, smooth + impulse)
    later = np.dot(sliders.release, impulse)
    state.past[:] = state.fresh
    for i in range(dofs):
        state.reaction[i] = smooth[i] + impulse[i]
        state.displacement[i] = predicted[i] + half**2 * free[i]
        state.velocity[i] = predicted[dofs + i] + half * free[i]
        state.acceleration[i] = free[i] + later[i]
    for place in range(made.traction.size):
        point = sliders.points[place // 2]
        state.forces[point, 1 + place % 2] += made.traction[place]
    return taken


@kernel
def _newton(
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
    scale, size = np.sqrt(np.dot(start[2], start[2])) + 1e-300, np.inf
    smooth: Array = np.zeros(rank)
    for iteration in range(NEWTON_LIMIT + 1):
        shrink, reached = 1.0, np.inf
        for _ in range(HALVINGS):
            made.acceleration[:] = guess - shrink * change[:rank]
            made.push[:] = pushed - shrink * change[rank:]
            smooth = _assemble(
                operators, sliders, compliance, points, state, start, made
            )
            reached = np.sqrt(np.dot(made.residual, made.residual))
            if reached < size:
                break
            shrink *= 0.5
        if not reached < size:
            return smooth, -1
        guess, pushed, size = made.acceleration.copy(), made.push.copy(), reached
        if size <= tolerance * (scale + np.sqrt(np.dot(guess, guess))):
            return smooth, iteration
        change = made.residual.copy()
        if not solve_in_place(made.matrix, change):
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
    tangent = np.empty((rank, rank))
    smooth = reaction_of(
        operators,
        points,
        state,
        start[0] + half**2 * made.acceleration,
        start[1] + half * made.acceleration,
        tangent,
        np.zeros((2, 3, 3)),
    )
    matrix, residual = made.matrix, made.residual
    matrix[:] = 0.0
    for place in range(sliders.points.size):
        _slide(operators, sliders, points, state, start, place, compliance[place], made)
    reaction = smooth + 2.0 * np.dot(sliders.rows.T, made.traction)
    residual[:rank] = (
        made.acceleration - start[2] + np.dot(operators.compliance, reaction)
    )
    matrix[:rank, :rank] += tangent
    matrix[:rank] = np.dot(operators.compliance, matrix[:rank].copy())
    for i in range(rank):
        matrix[i, i] += 1.0
    faster = (start[1] - start[3]) / half + made.acceleration
    residual[rank:] += np.dot(sliders.rows, faster)
    matrix[rank:, :rank] += sliders.rows
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
    momentum /= max(2.0 * half * compliance, 1e-300)
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
