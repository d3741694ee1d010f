"""One compiled march: average acceleration with a contact Newton (theory §7)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.memory import add_traction
from microslip_mechanics.contact.points import (
    ELASTIC,
    FRICTIONLESS,
    RIGID,
    ContactPoints,
)
from microslip_mechanics.jit import kernel
from timedomain.dense import solve_in_place
from timedomain.projection import projected
from timedomain.record import Meters, accumulate, store

NEWTON_LIMIT, HALVINGS = 50, 12


class Operators(NamedTuple):
    """Constant matrices of one step size (theory, eqs. 22–24)."""

    step: float
    """h [s]"""
    free: Array
    """free acceleration from the predicted (u, v), shape (dofs, 2 dofs)"""
    load: Array
    """free acceleration from the load factors, shape (dofs, loads)"""
    contact: Array
    """acceleration from contact forces, shape (dofs, rank)"""
    compliance: Array
    """relative acceleration from contact forces, shape (rank, rank)"""
    selection: Array
    """relative coordinates y from u, shape (rank, dofs)"""
    basis: Array
    """relative displacements of the points from y, shape (3 points, rank)"""


class State(NamedTuple):
    """What one step hands to the next; written in place."""

    displacement: Array
    velocity: Array
    acceleration: Array
    reaction: Array
    """contact force on the relative coordinates [N], shape (rank,)"""
    forces: Array
    """of each point [N], shape (points, 3)"""
    gaps: Array
    """relative displacement of each point [m], shape (points, 3)"""
    slips: Array
    """relative velocity of each point [m/s], shape (points, 3)"""
    past: Array
    """where each point was along its tangents when the step began [m], its traction [N]
    of friction that remembers, its velocity [m/s], and its normal load [N] with a zero;
    shape (points, 4, 2)"""
    fresh: Array
    """the same for now"""


@kernel
def march(
    operators: Operators,
    points: ContactPoints,
    state: State,
    meters: Meters,
    factors: Array,
    rows: Array,
    first: int,
    tolerance: float,
) -> tuple[int, int]:
    """March one step per row of ``factors``; stop where Newton does not converge.

    Parameters
    ----------
    operators, points
        Step matrices and contact table.
    state, meters
        Marched in place; left at the last converged step.
    factors
        Load factors at the new times, shape ``(steps, loads)``.
    rows
        Written every ``steps / len(rows)`` steps by :func:`timedomain.record.store`.
    first
        Where to begin in ``factors``.
    tolerance
        Of Newton's residual over the relative acceleration.

    Returns
    -------
    The step that failed, or the number of steps; and Newton iterations.
    """
    steps, stride = factors.shape[0], factors.shape[0] // rows.shape[0]
    tangents = np.zeros((2, 3, 3))
    predicted = np.zeros(2 * state.displacement.size)
    iterations = 0
    for step in range(first, steps):
        taken = _advance(
            operators, points, state, factors[step], tolerance, predicted, tangents
        )
        if taken < 0:
            return step, iterations
        iterations += taken
        accumulate(meters, points, state, factors[step], operators.step)
        if (step + 1) % stride == 0:
            store(meters, points, state, rows[step // stride])
    return steps, iterations


@kernel
def _advance(
    operators: Operators,
    points: ContactPoints,
    state: State,
    factors: Array,
    tolerance: float,
    predicted: Array,
    tangents: Array,
) -> int:
    """Take one step; return Newton's iterations, or −1 and an untouched motion."""
    half = 0.5 * operators.step
    dofs = state.displacement.size
    for i in range(dofs):
        speed = state.velocity[i] + half * state.acceleration[i]
        predicted[i] = state.displacement[i] + half * (state.velocity[i] + speed)
        predicted[dofs + i] = speed
    free = np.dot(operators.free, predicted) + np.dot(operators.load, factors)
    displacement = np.dot(operators.selection, predicted[:dofs])
    velocity = np.dot(operators.selection, predicted[dofs:])
    relative = np.dot(operators.selection, free)
    before = state.forces.copy()
    reaction, taken = _newton(
        operators, points, state, displacement, velocity, relative, tolerance, tangents
    )
    if taken < 0 and _rub(points):
        start = np.stack((displacement, velocity, relative))
        state.forces[:] = before
        reaction, taken = projected(
            operators.compliance, operators.basis, points, half, start, state.forces,
            state.gaps, state.slips, tolerance,
        )  # fmt: skip
    if taken < 0:
        return taken
    free -= np.dot(operators.contact, reaction)
    state.reaction[:] = reaction
    state.past[:] = state.fresh
    for i in range(dofs):
        state.acceleration[i] = free[i]
        state.displacement[i] = predicted[i] + half**2 * free[i]
        state.velocity[i] = predicted[dofs + i] + half * free[i]
    return taken


@kernel
def _rub(points: ContactPoints) -> bool:
    """Return whether points rub, and none remembers or is rigid."""
    kinds = points.friction
    return bool((kinds > FRICTIONLESS).any() and not (kinds >= ELASTIC).any())


@kernel
def _newton(
    operators: Operators,
    points: ContactPoints,
    state: State,
    displacement: Array,
    velocity: Array,
    free: Array,
    tolerance: float,
    tangents: Array,
) -> tuple[Array, int]:
    """Solve a = a_free − G φ(y + h²/4 a, ẏ + h/2 a) for the relative acceleration a.

    Return the contact force φ and the iterations, or −1. A step that does not lower
    the residual is halved (theory, eq. 24).
    """
    half = 0.5 * operators.step
    compliance = operators.compliance
    tangent = np.empty_like(compliance)
    guess = free - np.dot(compliance, state.reaction)
    change = np.zeros_like(guess)
    scale, size = _norm(free) + 1e-300, np.inf
    for iteration in range(NEWTON_LIMIT + 1):
        shrink, reached = 1.0, np.inf
        for _ in range(HALVINGS):
            trial = guess - shrink * change
            reaction = reaction_of(
                operators,
                points,
                state,
                displacement + half**2 * trial,
                velocity + half * trial,
                tangent,
                tangents,
            )
            residual = trial - free + np.dot(compliance, reaction)
            reached = _norm(residual)
            if reached < size:
                break
            shrink *= 0.5
        if not reached < size:
            return reaction, -1
        guess, size = trial, reached
        if size <= tolerance * (scale + _norm(guess)):
            return reaction, iteration
        matrix = np.dot(compliance, tangent)
        for i in range(guess.size):
            matrix[i, i] += 1.0
        change = residual.copy()
        if not solve_in_place(matrix, change):
            return reaction, -1
    return reaction, -1


@kernel
def reaction_of(
    operators: Operators,
    points: ContactPoints,
    state: State,
    displacement: Array,
    velocity: Array,
    tangent: Array,
    tangents: Array,
) -> Array:
    """Return the contact force on y; write its derivative by the acceleration."""
    basis = operators.basis
    reaction = np.zeros(displacement.size)
    tangent[:] = 0.0
    for point in range(points.load.size):
        rows = basis[3 * point : 3 * point + 3]
        for axis in range(3):
            state.gaps[point, axis] = _dot(rows[axis], displacement)
            state.slips[point, axis] = _dot(rows[axis], velocity)
        contact_force(
            points,
            point,
            state.gaps[point],
            state.slips[point],
            state.forces[point],
            tangents[0],
            tangents[1],
        )
        if ELASTIC <= points.friction[point] < RIGID:
            add_traction(
                points, point, state.gaps[point], state.slips[point],
                state.past[point], state.fresh[point], state.forces[point],
                tangents[0], tangents[1],
            )  # fmt: skip
        _scatter(operators.step, rows, state.forces[point], tangents, reaction, tangent)
    return reaction


@kernel
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


@kernel
def _dot(left: Array, right: Array) -> float:
    total = 0.0
    for i in range(left.size):
        total += left[i] * right[i]
    return total


@kernel
def _norm(vector: Array) -> float:
    return float(np.sqrt(_dot(vector, vector)))
