"""Floquet multipliers of a periodic response by marching small motions around it."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from small_motions.pieces import Pieces, pieces
from small_motions.propagator import propagate, propagator
from small_motions.relative_orbit import RelativeOrbit
from timedomain.shooting.floquet import Multipliers, extrapolated_multipliers
from timedomain.shooting.modal_structure import ModalStructure


def monodromy(problem: Problem, response: PeriodicResponse, *, steps: int) -> Array:
    """Return the map of a small motion (δu, δu̇) at phase 0 to one period later.

    The tangents K_c, C_c of the contact laws along the orbit make
    M δü + C δu̇ + K δu + Lᵀ (K_c L δu + C_c L δu̇) = 0 a linear equation with periodic
    coefficients. Steps begin and end at transitions between sticking, sliding and
    separation, so that the error falls with their number squared; without contact there
    is no error.

    Parameters
    ----------
    problem
        What moves.
    response
        The orbit; its harmonics are taken as exact.
    steps
        Over the period; a little more are taken.

    Returns
    -------
    Shape ``(2 dofs, 2 dofs)`` [m, rad and m/s, rad/s].
    """
    structure = ModalStructure.of(problem)
    orbit = RelativeOrbit.of(problem, response)
    scale = _scale(structure, response)
    marched = _marched(structure, orbit, pieces(orbit), steps, scale=scale)
    return _physical(structure, marched, scale)


def floquet_multipliers(
    problem: Problem, response: PeriodicResponse, *, steps: int
) -> Multipliers:
    """Return the multipliers, extrapolated from ``steps`` and half of them.

    A motion along an eigenvector is multiplied by its multiplier in each period: the
    orbit is stable if all are smaller than one. The error is that before the
    extrapolation, hence an upper bound where steps resolve the motion.
    """
    structure = ModalStructure.of(problem)
    orbit = RelativeOrbit.of(problem, response)
    cuts, scale = pieces(orbit), _scale(structure, response)
    coarse, fine = (
        _marched(structure, orbit, cuts, steps // 2, scale=scale, refinement=each)
        for each in (1, 2)
    )
    return extrapolated_multipliers(coarse, fine)


def _scale(structure: ModalStructure, response: PeriodicResponse) -> float:
    """Return s [rad/s]: velocities over it compare with displacements."""
    fastest = float(np.sqrt(structure.stiffness.max(initial=0.0)))
    return max(response.frequency, fastest)


def _marched(
    structure: ModalStructure,
    orbit: RelativeOrbit,
    cuts: Pieces,
    steps: int,
    *,
    scale: float,
    refinement: int = 1,
) -> Array:
    """Return the map of (q, q̇/s) over a period, each step in ``refinement`` parts."""
    counts = refinement * cuts.steps(steps)
    lengths = np.diff(cuts.edges) / counts
    state: Array = np.eye(2 * structure.stiffness.size)
    for count, begin, length in zip(counts, cuts.edges[:-1], lengths, strict=True):
        stiffness, damping = orbit.mean_tangents(begin, length, count)
        elastic, viscous = stiffness.mean(axis=0), damping.mean(axis=0)
        step = float(length) / orbit.motion.frequency
        state = propagate(
            propagator(structure, scale, elastic, viscous, step),
            stiffness - elastic,
            damping - viscous,
            state,
        )
    return state


def _physical(structure: ModalStructure, propagated: Array, scale: float) -> Array:
    """Return a map of (q, q̇/s) as the map of (u, u̇)."""
    modes = structure.stiffness.size
    result = np.empty_like(propagated)
    top, bottom = slice(modes), slice(modes, None)
    for row, up in ((top, 1.0), (bottom, scale)):
        for column, down in ((top, 1.0), (bottom, 1.0 / scale)):
            block = structure.shapes @ propagated[row, column] @ structure.inverse
            result[row, column] = up * down * block
    return result
