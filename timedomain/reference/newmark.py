"""One compiled march: average acceleration with a contact Newton (theory §7.1)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.points import ELASTIC, FRICTIONLESS, ContactPoints
from microslip_mechanics.jit import bare_kernel, kernel
from timedomain.contact.dense import copy, copy_rows, eliminate, norm
from timedomain.contact.operators import Operators
from timedomain.contact.reaction import react
from timedomain.contact.state import State
from timedomain.record.record import Meters, accumulate, store
from timedomain.reference.projection import projected

NEWTON_LIMIT, HALVINGS = 50, 12


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
        Written every ``steps / len(rows)`` steps by
        :func:`timedomain.record.record.store`.
    first
        Where to begin in ``factors``.
    tolerance
        Of Newton's residual over the relative acceleration.

    Returns
    -------
    The step that failed, or the number of steps; and Newton iterations.
    """
    steps, stride = factors.shape[0], factors.shape[0] // rows.shape[0]
    tangents = np.zeros((5, 3, 3))
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
        copy_rows(before, state.forces)
        reaction, taken = projected(
            operators.compliance, operators.basis, points, half, start, state.forces,
            state.gaps, state.slips, tolerance,
        )  # fmt: skip
    if taken < 0:
        return taken
    free -= np.dot(operators.contact, reaction)
    copy(reaction, state.reaction)
    copy(state.fresh.ravel(), state.past.ravel())
    for i in range(dofs):
        state.acceleration[i] = free[i]
        state.displacement[i] = predicted[i] + half**2 * free[i]
        state.velocity[i] = predicted[dofs + i] + half * free[i]
    return taken


@bare_kernel
def _rub(points: ContactPoints) -> bool:
    """Return whether points rub, and none remembers or is rigid."""
    rub = False
    for kind in points.friction:
        if kind >= ELASTIC:
            return False
        rub = rub or kind > FRICTIONLESS
    return rub


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
    tangent, reaction = np.empty_like(compliance), np.empty_like(free)
    guess = free - np.dot(compliance, state.reaction)
    change = np.zeros_like(guess)
    scale, size = norm(free) + TINY, np.inf
    for iteration in range(NEWTON_LIMIT + 1):
        shrink, reached = 1.0, np.inf
        for _ in range(HALVINGS):
            trial = guess - shrink * change
            react(
                operators,
                points,
                state,
                displacement + half**2 * trial,
                velocity + half * trial,
                reaction,
                tangent,
                tangents,
            )
            residual = trial - free + np.dot(compliance, reaction)
            reached = norm(residual)
            if reached < size:
                break
            shrink *= 0.5
        if not reached < size:
            return reaction, -1
        guess, size = trial, reached
        if size <= tolerance * (scale + norm(guess)):
            return reaction, iteration
        matrix = np.dot(compliance, tangent)
        for i in range(guess.size):
            matrix[i, i] += 1.0
        change = residual.copy()
        if not eliminate(matrix, change):
            return reaction, -1
    return reaction, -1
