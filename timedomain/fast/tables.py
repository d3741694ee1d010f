"""Step matrices of the fast march, for each length of a step (theory, §7.2)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from timedomain.fast.coordinates import Contacts, Modes
from timedomain.fast.propagators import embedded_difference, propagators
from timedomain.fast.schemes import Scheme

LEVELS = 24
"""of a ladder of steps, each half as long as the one before"""


class Tables(NamedTuple):
    """What depends on the step's length; the first axis is the level of the ladder."""

    ready: Array
    """1 where a level is made, shape (levels,)"""
    free: Array
    """E of :mod:`timedomain.fast.propagators`, shape (levels, stages, 2, 2, modes)"""
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
    """relative displacement by relative velocity [s], shape (levels, stages)"""
    weight: Array
    """Newton's scale of the friction of a point, shape (levels, stages, points)"""
    swing: Array
    """velocity at the end by a mean contact force, shape (levels, rank, rank)"""
    times: Array
    """of the stages, shape (stages + 1,)"""
    work: Array
    """quadrature of powers, shape (stages + 1,)"""
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
        np.zeros((LEVELS, stages)),
        np.zeros((LEVELS, stages, points)),
        np.zeros((LEVELS, rank, rank)),
        scheme.times,
        scheme.work,
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
    free, forced = propagators(scheme, modes, step)
    tables.free[level] = np.moveaxis(free[1:], 1, -1)
    tables.forced[level] = np.moveaxis(forced[1:], 2, -1)
    error = embedded_difference(scheme, modes, step, free, forced)
    tables.error_free[level] = np.moveaxis(error[0], 0, -1)
    tables.error_forced[level] = np.moveaxis(error[1], 1, -1)
    for stage in range(scheme.stages):
        _contact(tables, scheme, modes, contacts, level, stage, step)
    tables.ready[level] = 1.0


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
    if scheme.mean:
        tables.swing[level] = moving
        moving = (modes.selection * own[0]) @ modes.seen / step
    tables.compliance[level, stage] = moving
    tables.stiffness[level, stage] = np.linalg.inv(moving)
    tables.slope[level, stage] = step * scheme.matrix[stage + 1, stage + 1]
    _weigh(tables, contacts, level, stage, moving)


def _weigh(
    tables: Tables, contacts: Contacts, level: int, stage: int, moving: Array
) -> None:
    """Make the scales of the points' friction: how fast its own force moves each."""
    for point, (first, width) in enumerate(
        zip(contacts.first, contacts.width, strict=True)
    ):
        rows = contacts.basis[point, 1:, :width]
        block = moving[first : first + width, first : first + width]
        trace = np.einsum("ai,ij,aj->", rows, block, rows)
        tables.weight[level, stage, point] = 2.0 / trace if trace > 0.0 else 0.0
