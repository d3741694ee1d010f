"""Newton's method of a step whose friction is needed to stick, as a projection (§7.2).

Where the threshold velocity is far below what a step changes, Newton's iteration on
the law itself jumps from one sliding direction to the other. Here stick or slip follows
from the friction that is needed (:mod:`timedomain.contact.point_friction`); the
solution is the same.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel
from timedomain.contact.dense import copy_rows, dot, eliminate, norm
from timedomain.contact.point_law import linearise

NEWTON_LIMIT = 40
CAREFUL = 6
"""iterations with tangents before those with secants"""
ROUNDING = 4e-16
"""of the relative velocity: a change below it is the last one"""


class Lines(NamedTuple):
    """The contact law of all points, linear about a motion."""

    forces: Array
    """to begin with, and at the end: those that balance [N], shape (points, 3)"""
    values: Array
    """at the motion [N], shape (points, 3)"""
    by_gap: Array
    """shape (points, 3)"""
    by_slip: Array
    """shape (points, 3, 3)"""
    weight: Array
    """of each point's tangents [N s/m], shape (points,)"""


@kernel
def projected(
    compliance: Array,
    basis: Array,
    points: ContactPoints,
    half: float,
    start: Array,
    forces: Array,
    gaps: Array,
    slips: Array,
    tolerance: float,
) -> tuple[Array, int]:
    """Solve a = a_free − G φ(y + h²/4 a, ẏ + h/2 a) for the contact force φ.

    Parameters
    ----------
    compliance, basis
        G of the relative coordinates, and the points' displacements from them.
    points
        None of them remembers.
    half
        h/2 [s].
    start
        y, ẏ and a_free before the contact force, shape ``(3, rank)``.
    forces
        To begin with, (points, 3); overwritten, like the points' ``gaps`` and
        ``slips``.
    tolerance
        Of the residual over the relative acceleration.

    Returns
    -------
    The contact force and the iterations, or −1 if they do not converge.
    """
    rank, count = start.shape[1], points.load.size
    weight = _weights(compliance, basis, half, count)
    lines = Lines(
        forces, np.zeros((count, 3)), np.zeros((count, 3)), np.zeros((count, 3, 3)),
        weight,
    )  # fmt: skip
    reaction = np.dot(forces.ravel(), basis)
    guess = start[2] - np.dot(compliance, reaction)
    scale = norm(start[2]) + TINY
    for iteration in range(1, NEWTON_LIMIT + 1):
        _see(basis, half, start, guess, gaps, slips)
        tangent = _linearised(basis, points, half, iteration, gaps, slips, lines)
        reaction = np.dot(lines.values.ravel(), basis)
        change = guess - start[2] + np.dot(compliance, reaction)
        if norm(change) <= tolerance * (scale + norm(guess)):
            copy_rows(lines.values, forces)
            return reaction, iteration
        matrix = np.dot(compliance, tangent)
        for i in range(rank):
            matrix[i, i] += 1.0
        if not eliminate(matrix, change):
            return reaction, -1
        guess = guess - change
        _follow(basis, half, change, lines)
        moving = norm(start[1]) + half * norm(guess)
        if half * norm(change) <= ROUNDING * moving:
            _see(basis, half, start, guess, gaps, slips)
            return np.dot(forces.ravel(), basis), iteration
        if not math.isfinite(moving):
            return reaction, -1
    return reaction, -1


@kernel
def _weights(compliance: Array, basis: Array, half: float, count: int) -> Array:
    """Return what force stops the tangents of each point, by their velocity."""
    weight = np.zeros(count)
    for point in range(count):
        trace = 0.0
        for axis in range(1, 3):
            row = basis[3 * point + axis]
            trace += half * np.dot(row, np.dot(compliance, row))
        if trace > 0.0:
            weight[point] = 2.0 / trace
    return weight


@kernel
def _see(
    basis: Array, half: float, start: Array, guess: Array, gaps: Array, slips: Array
) -> None:
    """Write the points' motion under a relative acceleration."""
    displacement, velocity = start[0] + half**2 * guess, start[1] + half * guess
    for point in range(gaps.shape[0]):
        for axis in range(3):
            row = basis[3 * point + axis]
            gaps[point, axis] = dot(row, displacement)
            slips[point, axis] = dot(row, velocity)


@kernel
def _linearised(
    basis: Array,
    points: ContactPoints,
    half: float,
    iteration: int,
    gaps: Array,
    slips: Array,
    lines: Lines,
) -> Array:
    """Write the forces of all points; return their derivative by the acceleration."""
    tangent = np.zeros((basis.shape[1], basis.shape[1]))
    ends = np.zeros(0)
    for point in range(points.load.size):
        linearise(
            points, point, lines.weight[point], iteration > CAREFUL, ends, gaps, slips,
            lines.forces, lines.values, lines.by_gap, lines.by_slip,
        )  # fmt: skip
        slope = half * lines.by_slip[point]
        for axis in range(3):
            slope[axis, 0] += half**2 * lines.by_gap[point, axis]
        rows = np.ascontiguousarray(basis[3 * point : 3 * point + 3])
        tangent += np.dot(rows.T, np.dot(slope, rows))
    return tangent


@kernel
def _follow(basis: Array, half: float, change: Array, lines: Lines) -> None:
    """Write the forces that belong to a change of the acceleration taken away."""
    moved = np.dot(basis, change)
    for point in range(lines.weight.size):
        first = moved[3 * point : 3 * point + 3]
        for axis in range(3):
            force = lines.values[point, axis]
            force -= half**2 * lines.by_gap[point, axis] * first[0]
            for other in range(3):
                force -= half * lines.by_slip[point, axis, other] * first[other]
            lines.forces[point, axis] = force
