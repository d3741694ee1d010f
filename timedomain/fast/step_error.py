"""The error of a step of the fast march (theory, §7.2)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import TINY
from microslip_mechanics.jit import bare_kernel, inner_kernel
from timedomain.fast.coordinates import Modes
from timedomain.fast.coupling import coupling_error
from timedomain.fast.motion import LENGTH, REFERENCE, Control, Motion, Trial
from timedomain.fast.tables import Tables

DIGITS = 2e-14
"""relative error of a displacement that counts as rounding"""


@bare_kernel
def step_error(
    control: Control,
    modes: Modes,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    level: int,
    safe: bool,
) -> float:
    """Return the error of the step over the tolerance; 0 if steps have one length.

    It is compared with the largest kinetic energy so far, which no preload is part of.
    """
    if control.tolerance == 0.0:
        return 0.0
    length, now = control.longest / 2.0**level, 0.0
    for j in range(motion.velocity.size):
        now += motion.velocity[j] ** 2
    reference = max(motion.numbers[REFERENCE], now)
    motion.numbers[REFERENCE] = reference
    if safe:
        energy = _embedded(modes, tables, motion, trial, level)
    else:
        energy = _curvature(modes, motion, trial, length)
    energy += coupling_error(modes, motion, trial, length)
    trial.numbers[2] = energy
    accepted = control.tolerance**2 * reference
    if energy > accepted:
        accepted += _rounding(modes, motion, length)
    return float(np.sqrt(energy / accepted))


@inner_kernel
def _rounding(modes: Modes, motion: Motion, length: float) -> float:
    """Return twice the energy [J] of what rounding may do to a step.

    It changes displacements where contacts are, and what holds them sees that as a
    velocity.
    """
    energy = 0.0
    for i in range(modes.selection.shape[0]):
        size = 0.0
        for j in range(motion.displacement.size):
            size += abs(modes.selection[i, j] * motion.displacement[j])
        energy += (DIGITS * size / length) ** 2 / max(modes.mobility[i, i], TINY)
    return energy


@inner_kernel
def _embedded(
    modes: Modes, tables: Tables, motion: Motion, trial: Trial, level: int
) -> float:
    """Return twice the energy of the difference from the embedded solution."""
    free, forced = tables.error_free[level], tables.error_forced[level]
    energy, drift = 0.0, 0.0
    for j in range(motion.velocity.size):
        q, v = motion.displacement[j], motion.velocity[j]
        moved = free[0, 0, j] * q + free[0, 1, j] * v
        moving = free[1, 0, j] * q + free[1, 1, j] * v
        for stage in range(tables.times.size):
            moved += forced[stage, 0, j] * trial.force[stage, j]
            moving += forced[stage, 1, j] * trial.force[stage, j]
        energy += moving**2 + modes.stiffness[j] * moved**2
        drift += moving * v + modes.stiffness[j] * moved * q
    trial.numbers[0] = drift
    return energy


@inner_kernel
def _curvature(modes: Modes, motion: Motion, trial: Trial, length: float) -> float:
    """Return twice the energy of what a linear contact force leaves out.

    An interpolation that leaves out the curvature φ″ changes the velocity by h³ φ″/12.
    """
    rank = trial.curvature.size
    share = length**3 / 6.0 / (length + motion.numbers[LENGTH])
    for i in range(rank):
        rate = (trial.local.reaction[i] - motion.reaction[0, i]) / length
        trial.local.change[1, i] = share * (rate - motion.reaction[1, i])
    energy, drift = 0.0, 0.0
    for i in range(rank):
        force = trial.local.change[1, i]
        drift -= force * trial.local.velocity[i]
        for j in range(rank):
            energy += force * modes.mobility[i, j] * trial.local.change[1, j]
    trial.numbers[0] = drift
    return energy
