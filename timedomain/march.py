"""The compiled time step: generalised-α with a contact Newton (theory §7)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import (
    ContactPoints,
    contact_energy,
    contact_force,
    contact_power,
)
from microslip_mechanics.jit import kernel

ENERGIES = ("input", "friction", "normal_damping", "structural", "friction_work")
"""what is integrated over the march [J]"""


class Operators(NamedTuple):
    """Constant matrices of one step size (theory, eqs. 21–24)."""

    free: Array
    """free acceleration from (u, v, a), shape (dofs, 3 dofs)"""
    load: Array
    """free acceleration from the load factors, shape (dofs, loads)"""
    contact: Array
    """acceleration from contact forces, shape (dofs, rank)"""
    compliance: Array
    """relative acceleration from contact forces, shape (rank, rank)"""
    selection: Array
    """relative coordinates from u, shape (rank, dofs)"""
    basis: Array
    """relative displacements of the points, shape (3 points, rank)"""
    mass: Array
    damping: Array
    stiffness: Array
    shapes: Array
    """loads, shape (dofs, loads)"""
    probes: Array
    """shape (probes, dofs)"""
    step: float
    """h [s]"""
    alpha: float
    """α_f: weight of the old forces in the balance"""
    beta: float
    gamma: float


class State(NamedTuple):
    """What one step hands to the next; marched in place."""

    displacement: Array
    velocity: Array
    acceleration: Array
    reaction: Array
    """contact force in relative coordinates [N], shape (rank,)"""
    powers: Array
    """of ENERGIES at the last step [W]"""
    energies: Array
    """ENERGIES so far [J]"""


@kernel
def march(
    operators: Operators,
    points: ContactPoints,
    state: State,
    factors: Array,
    stride: int,
    tolerance: float,
) -> tuple[int, int, Array]:
    """March one step per row of ``factors``; stop where Newton does not converge.

    Parameters
    ----------
    operators, points
        Step matrices and contact table.
    state
        Marched in place.
    factors
        Load factors at the old and all new times, shape ``(steps + 1, loads)``.
    stride
        Steps per stored row; divides the number of steps.
    tolerance
        Of Newton's residual over the relative acceleration.

    Returns
    -------
    steps, iterations
        Converged steps (all of them, unless Newton failed) and Newton iterations.
    rows
        Stored rows, shape ``(steps // stride, columns)``; see :func:`_store`.
    """
    steps = factors.shape[0] - 1
    rank, dofs = operators.selection.shape
    work = _workspace(points.load.size, rank, dofs)
    rows = np.zeros((steps // stride, columns(operators, points)))
    iterations = 0
    alpha = operators.alpha
    for step in range(steps):
        mean = (1.0 - alpha) * factors[step + 1] + alpha * factors[step]
        taken = _advance(operators, points, state, mean, tolerance, work)
        if taken < 0:
            return step, iterations, rows
        iterations += taken
        _accumulate(operators, points, state, factors[step + 1], work)
        if (step + 1) % stride == 0:
            _store(operators, points, state, work, rows[step // stride])
    return steps, iterations, rows


class Work(NamedTuple):
    """Arrays that the step writes and nobody keeps."""

    stacked: Array
    displacement: Array
    velocity: Array
    points: Array
    point_velocity: Array
    forces: Array
    force: Array
    tangent_displacement: Array
    tangent_velocity: Array
    matrix: Array
    tangent: Array


@kernel
def _workspace(points: int, rank: int, dofs: int) -> Work:
    return Work(
        np.zeros(3 * dofs),
        np.zeros(dofs),
        np.zeros(dofs),
        np.zeros((points, 3)),
        np.zeros((points, 3)),
        np.zeros((points, 3)),
        np.zeros(3),
        np.zeros((3, 3)),
        np.zeros((3, 3)),
        np.zeros((rank, rank)),
        np.zeros((rank, rank)),
    )


@kernel
def _advance(
    operators: Operators,
    points: ContactPoints,
    state: State,
    mean: Array,
    tolerance: float,
    work: Work,
) -> int:
    """Take one step; return Newton's iterations, or −1 if it does not converge."""
    step, alpha = operators.step, operators.alpha
    dofs = state.displacement.size
    work.stacked[:dofs] = state.displacement
    work.stacked[dofs : 2 * dofs] = state.velocity
    work.stacked[2 * dofs :] = state.acceleration
    free = np.dot(operators.free, work.stacked) + np.dot(operators.load, mean)
    if alpha != 0.0:
        free -= alpha * np.dot(operators.contact, state.reaction)
    for i in range(dofs):
        work.displacement[i] = state.displacement[i] + step * (
            state.velocity[i] + step * (0.5 - operators.beta) * state.acceleration[i]
        )
        work.velocity[i] = (
            state.velocity[i] + step * (1.0 - operators.gamma) * state.acceleration[i]
        )
    relative_free = np.dot(operators.selection, free)
    displacement = np.dot(operators.selection, work.displacement)
    velocity = np.dot(operators.selection, work.velocity)
    jump, reaction, taken = _newton(
        operators, points, displacement, velocity, relative_free, state, tolerance, work
    )
    if taken < 0:
        return taken
    free -= (1.0 - alpha) * np.dot(operators.contact, reaction)
    state.reaction[:] = reaction
    for i in range(dofs):
        state.acceleration[i] = free[i]
        state.displacement[i] = work.displacement[i] + step**2 * operators.beta * free[i]
        state.velocity[i] = work.velocity[i] + step * operators.gamma * free[i]
    return taken


@kernel
def _newton(
    operators: Operators,
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    free: Array,
    state: State,
    tolerance: float,
    work: Work,
) -> tuple[Array, Array, int]:
    """Solve a = a_free − G φ(y(a), ẏ(a)) for the relative acceleration a."""
    by_displacement = operators.step**2 * operators.beta
    by_velocity = operators.step * operators.gamma
    guess = free - (1.0 - operators.alpha) * np.dot(operators.compliance, state.reaction)
    reaction = _reaction(
        operators, points, displacement + by_displacement * guess,
        velocity + by_velocity * guess, by_displacement, by_velocity, work,
    )  # fmt: skip
    weight = 1.0 - operators.alpha
    residual = guess - free + weight * np.dot(operators.compliance, reaction)
    scale = np.sqrt(np.dot(free, free)) + 1e-30
    size = np.sqrt(np.dot(residual, residual))
    for iteration in range(60):
        if size <= tolerance * (scale + np.sqrt(np.dot(guess, guess))):
            return guess, reaction, iteration
        matrix = weight * np.dot(operators.compliance, work.tangent)
        for i in range(guess.size):
            matrix[i, i] += 1.0
        change = np.linalg.solve(matrix, residual)
        shrink = 1.0
        while True:
            trial = guess - shrink * change
            candidate = _reaction(
                operators, points, displacement + by_displacement * trial,
                velocity + by_velocity * trial, by_displacement, by_velocity, work,
            )  # fmt: skip
            defect = trial - free + weight * np.dot(operators.compliance, candidate)
            reached = np.sqrt(np.dot(defect, defect))
            if reached < size * (1.0 - 1e-4 * shrink) or shrink < 1e-4:
                break
            shrink *= 0.5
        guess, reaction, residual, size = trial, candidate, defect, reached
    return guess, reaction, -1


@kernel
def _reaction(
    operators: Operators,
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    by_displacement: float,
    by_velocity: float,
    work: Work,
) -> Array:
    """Return the contact force in relative coordinates; write its tangent."""
    basis = operators.basis
    rank = displacement.size
    reaction = np.zeros(rank)
    work.tangent[:] = 0.0
    for point in range(points.load.size):
        for axis in range(3):
            moved, moving = 0.0, 0.0
            for i in range(rank):
                moved += basis[3 * point + axis, i] * displacement[i]
                moving += basis[3 * point + axis, i] * velocity[i]
            work.points[point, axis] = moved
            work.point_velocity[point, axis] = moving
        contact_force(
            points, point, work.points[point], work.point_velocity[point],
            work.force, work.tangent_displacement, work.tangent_velocity,
        )  # fmt: skip
        work.forces[point] = work.force
        for axis in range(3):
            for i in range(rank):
                reaction[i] += basis[3 * point + axis, i] * work.force[axis]
            for other in range(3):
                tangent = (
                    by_displacement * work.tangent_displacement[axis, other]
                    + by_velocity * work.tangent_velocity[axis, other]
                )
                if tangent == 0.0:
                    continue
                for i in range(rank):
                    left = basis[3 * point + axis, i] * tangent
                    for j in range(rank):
                        work.tangent[i, j] += left * basis[3 * point + other, j]
    return reaction


@kernel
def _accumulate(
    operators: Operators,
    points: ContactPoints,
    state: State,
    factors: Array,
    work: Work,
) -> None:
    """Add the work of this step to the energies, by the trapezoidal rule."""
    friction, damping, old_friction = 0.0, 0.0, 0.0
    for point in range(points.load.size):
        slid, damped = contact_power(
            points, point, work.points[point], work.point_velocity[point],
            work.forces[point],
        )  # fmt: skip
        friction += slid
        damping += damped
    loads = np.dot(operators.shapes, factors)
    powers = (
        np.dot(loads, state.velocity),
        friction,
        damping,
        np.dot(state.velocity, np.dot(operators.damping, state.velocity)),
    )
    for kind in range(4):
        state.energies[kind] += 0.5 * operators.step * (state.powers[kind] + powers[kind])
        state.powers[kind] = powers[kind]


@kernel
def columns(operators: Operators, points: ContactPoints) -> int:
    """Return the length of a stored row."""
    return 2 * operators.probes.shape[0] + points.load.size + 1 + 5 + 3


@kernel
def _store(
    operators: Operators, points: ContactPoints, state: State, work: Work, row: Array
) -> None:
    """Write probes, their velocities, normal forces, friction power and energies."""
    probes = operators.probes.shape[0]
    row[:probes] = np.dot(operators.probes, state.displacement)
    row[probes : 2 * probes] = np.dot(operators.probes, state.velocity)
    place = 2 * probes
    stored = 0.0
    for point in range(points.load.size):
        row[place + point] = work.forces[point, 0]
        stored += contact_energy(points, point, work.points[point, 0])
    place += points.load.size
    row[place] = state.powers[1]
    row[place + 1 : place + 6] = state.energies
    u, v = state.displacement, state.velocity
    row[place + 6] = 0.5 * np.dot(v, np.dot(operators.mass, v))
    row[place + 7] = 0.5 * np.dot(u, np.dot(operators.stiffness, u))
    row[place + 8] = stored
