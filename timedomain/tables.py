"""Step matrices of the fast march, for each length of a step (theory, §7)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import scipy.linalg

from microslip_mechanics.arrays import Array
from timedomain.coordinates import Contacts, Modes
from timedomain.schemes import Scheme

LEVELS = 24
"""of a ladder of steps, each half as long as the one before"""


class Tables(NamedTuple):
    """What depends on the step's length; the first axis is the level of the ladder.

    A stage is z_k = E_k z_0 + Σ_j Q_kj f_j in each mode, with z = (q, q̇) and the modal
    forces f_j of the stages j = 0 … k.
    """

    ready: Array
    """1 where a level is made, shape (levels,)"""
    free: Array
    """E, shape (levels, stages, 2, 2, modes)"""
    forced: Array
    """Q, shape (levels, stages, stages + 1, 2, modes)"""
    error_free: Array
    """the same for the difference from the embedded solution, (levels, 2, 2, modes)"""
    error_forced: Array
    """shape (levels, stages + 1, 2, modes)"""
    compliance: Array
    """relative velocity from a contact force, shape (levels, stages, rank, rank)"""
    stiffness: Array
    """its inverse"""
    slope: Array
    """relative displacement by relative velocity, shape (levels, stages, rank, rank)"""
    weight: Array
    """Newton's scale of the friction of a point, shape (levels, stages, points)"""
    swing: Array
    """velocity at the end by a mean contact force, shape (levels, rank, rank)"""
    depth: Array
    """normal displacement of a point from its force [m/N], (levels, stages, points)"""
    times: Array
    """of the stages, shape (stages + 1,)"""
    work: Array
    """quadrature of powers, shape (stages + 1,)"""
    scalar: Array
    """the slope where it is a multiple of the unit matrix, else −1, (levels, stages)"""
    mean: float
    """1 if the contact force is a mean one, else 0"""


def empty_tables(scheme: Scheme, modes: Modes, contacts: Contacts) -> Tables:
    """Return tables of which no level is made."""
    count, stages = modes.stiffness.size, scheme.stages
    rank, points = modes.selection.shape[0], contacts.first.size
    square = (LEVELS, stages, rank, rank)
    return Tables(
        np.zeros(LEVELS),
        np.zeros((LEVELS, stages, 2, 2, count)),
        np.zeros((LEVELS, stages, stages + 1, 2, count)),
        np.zeros((LEVELS, 2, 2, count)),
        np.zeros((LEVELS, stages + 1, 2, count)),
        np.zeros(square),
        np.zeros(square),
        np.zeros(square),
        np.zeros((LEVELS, stages, points)),
        np.zeros((LEVELS, rank, rank)),
        np.zeros((LEVELS, stages, points)),
        scheme.times,
        scheme.work,
        np.zeros((LEVELS, stages)),
        float(scheme.mean),
    )


def fill(
    tables: Tables,
    scheme: Scheme,
    modes: Modes,
    contacts: Contacts,
    *,
    level: int,
    step: float,
) -> None:
    """Make the tables of a level, whose steps have the length ``step`` [s]."""
    free, forced = (
        _exact(modes, step) if scheme.exact else _implicit(scheme, modes, step)
    )
    tables.free[level] = np.moveaxis(free[1:], 1, -1)
    tables.forced[level] = np.moveaxis(forced[1:], 2, -1)
    error = _error(scheme, modes, step, free, forced)
    tables.error_free[level] = np.moveaxis(error[0], 0, -1)
    tables.error_forced[level] = np.moveaxis(error[1], 1, -1)
    for stage in range(scheme.stages):
        _contact(tables, scheme, modes, contacts, level, stage, step)
    tables.ready[level] = 1.0


def _system(modes: Modes) -> Array:
    """Return (q, q̇) to its rate in each mode, shape (modes, 2, 2)."""
    system = np.zeros((modes.stiffness.size, 2, 2))
    system[:, 0, 1] = 1.0
    system[:, 1, 0], system[:, 1, 1] = -modes.stiffness, -modes.damping
    return system


def _implicit(scheme: Scheme, modes: Modes, step: float) -> tuple[Array, Array]:
    """Return E and Q of a Runge–Kutta scheme, modes before the rest."""
    system, stages = _system(modes), scheme.stages
    count = len(system)
    free = np.zeros((stages + 1, count, 2, 2))
    forced = np.zeros((stages + 1, stages + 1, count, 2))
    free[0] = np.eye(2)
    for stage in range(1, stages + 1):
        row = step * scheme.matrix[stage]
        free[stage] = np.eye(2)
        for before in range(stage):
            free[stage] += row[before] * system @ free[before]
            forced[stage] += row[before] * np.einsum(
                "mab,jmb->jma", system, forced[before]
            )
            forced[stage, before, :, 1] += row[before]
        forced[stage, stage, :, 1] += row[stage]
        solver = np.linalg.inv(np.eye(2) - row[stage] * system)
        free[stage] = solver @ free[stage]
        forced[stage] = np.einsum("mab,jmb->jma", solver, forced[stage])
    return free, forced


def _exact(modes: Modes, step: float) -> tuple[Array, Array]:
    """Return E and Q for a force that is linear over the step, solved exactly."""
    count = modes.stiffness.size
    augmented = np.zeros((count, 4, 4))
    augmented[:, :2, :2] = step * _system(modes)
    augmented[:, 1, 2], augmented[:, 2, 3] = step, 1.0
    moved = scipy.linalg.expm(augmented)
    free = np.stack([np.broadcast_to(np.eye(2), (count, 2, 2)), moved[:, :2, :2]])
    forced = np.zeros((2, 2, count, 2))
    forced[1, 1] = moved[:, :2, 3]
    forced[1, 0] = moved[:, :2, 2] - moved[:, :2, 3]
    return free, forced


def _error(
    scheme: Scheme, modes: Modes, step: float, free: Array, forced: Array
) -> tuple[Array, Array]:
    """Return the filtered difference from the embedded solution, as E and Q."""
    system = _system(modes)
    weights = step * (scheme.matrix[-1] - scheme.other)
    solver = np.linalg.inv(np.eye(2) - step * scheme.matrix[-1, -1] * system)
    by_state = sum(w * system @ each for w, each in zip(weights, free, strict=True))
    by_force = sum(
        w * np.einsum("mab,jmb->jma", system, each)
        for w, each in zip(weights, forced, strict=True)
    )
    by_force[:, :, 1] += weights[:, None]
    return solver @ by_state, np.einsum("mab,jmb->jma", solver, by_force)


def _contact(
    tables: Tables,
    scheme: Scheme,
    modes: Modes,
    contacts: Contacts,
    level: int,
    stage: int,
    step: float,
) -> None:
    """Make the matrices of the contact Newton of one stage."""
    own = tables.forced[level, stage, stage + 1]
    if scheme.mean:
        own = tables.forced[level, stage].sum(axis=0)
    moving = (modes.selection * own[1]) @ modes.seen
    moved = (modes.selection * own[0]) @ modes.seen
    if scheme.mean:
        tables.swing[level] = moving
        moving, moved = moved / step, 0.5 * moved
    inverse = np.linalg.inv(moving)
    tables.compliance[level, stage], tables.stiffness[level, stage] = moving, inverse
    if scheme.mean:
        tables.scalar[level, stage] = 0.5 * step
    elif scheme.exact:
        tables.scalar[level, stage] = -1.0
        tables.slope[level, stage] = moved @ inverse
    else:
        tables.scalar[level, stage] = step * scheme.matrix[stage + 1, stage + 1]
        tables.slope[level, stage] = tables.scalar[level, stage] * np.eye(len(moving))
    for point, (first, width) in enumerate(
        zip(contacts.first, contacts.width, strict=True)
    ):
        rows = contacts.basis[point, 1:, :width]
        block = moving[first : first + width, first : first + width]
        trace = np.einsum("ai,ij,aj->", rows, block, rows)
        tables.weight[level, stage, point] = 2.0 / trace if trace > 0.0 else 0.0
        row = contacts.basis[point, 0, :width]
        block = moved[first : first + width, first : first + width]
        tables.depth[level, stage, point] = row @ block @ row
