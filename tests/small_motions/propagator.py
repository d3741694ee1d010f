"""A small motion over one step: structure and mean contact exact, the rest implicit.

In mass-normalised modes the state is (q, q̇/s) with a scale s of velocities. Over a
piece of the period the contact has the mean tangents K̄, C̄ and deviates from them by
K', C'. Structure and mean tangents are one constant matrix A, whose exponential is
exact over a step h. The deviation's force is held constant over a step,

    f = K' (y₀ + y₁)/2 + C' (y₁ − y₀)/h ,    y₁ = y₁(free) − D f ,

which is of second order and symmetric in time: errors are even in h. It is stable for
every h where K̄ + K' and C̄ + C' are symmetric and not negative: f does the work
−½ Δ(yᵀ K' y) − Δyᵀ C' Δy/h, and C̄ takes out Δyᵀ C̄ Δy/h or more.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel
from timedomain.shooting.modal_structure import ModalStructure


class Propagator(NamedTuple):
    """One step with constant tangents, and its answer to a constant contact force."""

    step: float
    """h [s]"""
    free: Array
    """exp(A h), shape (2 modes, 2 modes)"""
    answer: Array
    """state from a contact force on the relative coordinates, (2 modes, rank)"""
    compliance: Array
    """D [m/N]: relative displacement from that force, shape (rank, rank)"""
    selection: Array
    """relative coordinates from the modes, shape (rank, modes)"""


def propagator(
    structure: ModalStructure,
    scale: float,
    stiffness: Array,
    damping: Array,
    step: float,
) -> Propagator:
    """Return the step with constant contact tangents, each of shape (rank, rank)."""
    selection = structure.selection
    rank, modes = selection.shape
    matrix = np.zeros((2 * modes + rank, 2 * modes + rank))
    top, bottom = slice(modes), slice(modes, 2 * modes)
    matrix[top, bottom] = scale * np.eye(modes)
    elastic = np.diag(structure.stiffness) + selection.T @ stiffness @ selection
    matrix[bottom, top] = -elastic / scale
    matrix[bottom, bottom] = -structure.damping - selection.T @ damping @ selection
    matrix[bottom, 2 * modes :] = selection.T / scale
    moved = scipy.linalg.expm(step * matrix)
    answer = np.ascontiguousarray(moved[: 2 * modes, 2 * modes :])
    free = np.ascontiguousarray(moved[: 2 * modes, : 2 * modes])
    return Propagator(step, free, answer, selection @ answer[:modes], selection)


@kernel
def propagate(
    propagator: Propagator, stiffness: Array, damping: Array, state: Array
) -> Array:
    """Return states after one step for each deviation of the tangents from the mean.

    Parameters
    ----------
    propagator
        The step with the mean tangents.
    stiffness, damping
        K' [N/m] and C' [N s/m] at mid-step, each of shape ``(steps, rank, rank)``.
    state
        States in its columns, shape ``(2 modes, columns)``.
    """
    rank, modes = propagator.selection.shape
    for step in range(stiffness.shape[0]):
        after = np.dot(propagator.free, state)
        if rank > 0:
            elastic = 0.5 * stiffness[step]
            viscous = damping[step] / propagator.step
            forward = elastic + viscous
            old = np.dot(propagator.selection, state[:modes])
            new = np.dot(propagator.selection, after[:modes])
            known = np.dot(forward, new) + np.dot(elastic - viscous, old)
            matrix = np.eye(rank) + np.dot(forward, propagator.compliance)
            after -= np.dot(propagator.answer, np.linalg.solve(matrix, known))
        state = after
    return state
