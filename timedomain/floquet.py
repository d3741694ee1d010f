"""Floquet multipliers of a periodic response by marching small motions around it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from timedomain.pieces import Pieces, pieces
from timedomain.propagator import ModalStructure, propagate, propagator
from timedomain.relative_orbit import RelativeOrbit

RESOLVED = 0.1
"""change of a multiplier from half the steps up to which it is extrapolated"""


@dataclass(frozen=True, slots=True)
class Multipliers:
    """Floquet multipliers and how far they may be wrong."""

    values: ComplexArray
    """by falling modulus, shape (2 dofs,)"""
    error: Array
    """how far extrapolation from steps to half of them moved each, shape (2 dofs,)"""


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
    structure = ModalStructure.of(problem, response.frequency)
    orbit = RelativeOrbit.of(problem, response)
    return structure.physical(_marched(structure, orbit, pieces(orbit), steps))


def floquet_multipliers(
    problem: Problem, response: PeriodicResponse, *, steps: int
) -> Multipliers:
    """Return the multipliers, extrapolated from ``steps`` and half of them.

    A motion along an eigenvector is multiplied by its multiplier in each period: the
    orbit is stable if all are smaller than one. The error is that before the
    extrapolation, hence an upper bound where steps resolve the motion.
    """
    structure = ModalStructure.of(problem, response.frequency)
    orbit = RelativeOrbit.of(problem, response)
    cuts = pieces(orbit)
    coarse, fine = (
        _marched(structure, orbit, cuts, steps // 2, refinement=each) for each in (1, 2)
    )
    return extrapolated_multipliers(coarse, fine)


def extrapolated_multipliers(coarse: Array, fine: Array) -> Multipliers:
    """Return the multipliers of maps by steps and by half of them, extrapolated.

    The maps are extrapolated, unless the steps do not resolve the fastest motions,
    whose phases are arbitrary then: that would let them grow. Multipliers that changed
    by more than :data:`RESOLVED` are left as they are, the others extrapolated one by
    one. All are infinite where small motions grow beyond all numbers.
    """
    if not np.isfinite([coarse, fine]).all():
        beyond = np.full(len(fine), np.inf)
        return Multipliers(beyond.astype(complex), beyond)
    before = np.linalg.eigvals(coarse)
    values = np.linalg.eigvals(fine + (fine - coarse) / 3.0).astype(complex)
    distance = np.abs(values[:, None] - before)
    each, paired = linear_sum_assignment(distance)
    error = distance[each, paired]
    if error.max(initial=0.0) > RESOLVED:
        values, error = _one_by_one(coarse, fine)
    order = np.argsort(-np.abs(values), kind="stable")
    return Multipliers(values[order], error[order])


def _one_by_one(coarse: Array, fine: Array) -> tuple[ComplexArray, Array]:
    """Return the eigenvalues of the finer map, and how far each was away.

    Those of alike shapes belong together, however far apart they are.
    """
    (before, shapes), (values, motions) = map(np.linalg.eig, (coarse, fine))
    alike = np.abs(motions.conj().T @ shapes)
    _, paired = linear_sum_assignment(-alike)
    moved = values - before[paired]
    error = np.abs(moved)
    found = values + np.where(error <= RESOLVED, moved / 3.0, 0.0)
    return found.astype(complex), error


def _marched(
    structure: ModalStructure,
    orbit: RelativeOrbit,
    cuts: Pieces,
    steps: int,
    *,
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
            propagator(structure, elastic, viscous, step),
            stiffness - elastic,
            damping - viscous,
            state,
        )
    return state
