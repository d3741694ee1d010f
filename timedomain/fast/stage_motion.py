"""The motion of a stage of the fast march, without and with its contact force."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import inner_kernel
from timedomain.fast.coordinates import Contacts, Modes
from timedomain.fast.motion import Motion, Trial
from timedomain.fast.tables import Tables


@inner_kernel
def predict_stage(
    modes: Modes, tables: Tables, motion: Motion, trial: Trial, level: int, stage: int
) -> None:
    """Write the stage without its contact force, and its relative motion."""
    free, forced = tables.free[level, stage - 1], tables.forced[level, stage - 1]
    moved, moving = trial.displacement, trial.velocity
    for j in range(moved.size):
        q, v = motion.displacement[j], motion.velocity[j]
        moved[j] = free[0, 0, j] * q + free[0, 1, j] * v
        moving[j] = free[1, 0, j] * q + free[1, 1, j] * v
    for before in range(stage + 1):
        force = trial.force[before]
        for j in range(moved.size):
            moved[j] += forced[before, 0, j] * force[j]
            moving[j] += forced[before, 1, j] * force[j]
    for i in range(modes.selection.shape[0]):
        trial.relative[0, i], trial.relative[1, i] = _seen(
            modes.selection[i], moved, moving
        )


@inner_kernel
def _seen(row: Array, moved: Array, moving: Array) -> tuple[float, float]:
    """Return two inner products, each in four sums that do not wait for each other."""
    q0 = q1 = q2 = q3 = v0 = v1 = v2 = v3 = 0.0
    whole = row.size // 4 * 4
    for j in range(0, whole, 4):
        q0 += row[j] * moved[j]
        q1 += row[j + 1] * moved[j + 1]
        q2 += row[j + 2] * moved[j + 2]
        q3 += row[j + 3] * moved[j + 3]
        v0 += row[j] * moving[j]
        v1 += row[j + 1] * moving[j + 1]
        v2 += row[j + 2] * moving[j + 2]
        v3 += row[j + 3] * moving[j + 3]
    for j in range(whole, row.size):
        q0 += row[j] * moved[j]
        v0 += row[j] * moving[j]
    return q0 + q1 + q2 + q3, v0 + v1 + v2 + v3


@inner_kernel
def average_stage(
    contacts: Contacts, motion: Motion, trial: Trial, length: float
) -> None:
    """Make means over the step of the relative motion at its end."""
    for point in range(contacts.first.size):
        gap, first = 0.0, contacts.first[point]
        for i in range(contacts.width[point]):
            gap += contacts.basis[point, 0, i] * motion.relative[0, first + i]
        trial.begins[point] = gap
    for i in range(trial.curvature.size):
        begin, end = motion.relative[0, i], trial.relative[0, i]
        trial.curvature[i] = trial.relative[1, i]
        trial.relative[0, i] = 0.5 * (begin + end)
        trial.relative[1, i] = (end - begin) / length


@inner_kernel
def complete_stage(
    modes: Modes, tables: Tables, trial: Trial, level: int, stage: int
) -> None:
    """Add the contact force to a stage."""
    modal_contact_force(modes, trial)
    first = 0 if tables.mean > 0.0 else stage
    for before in range(first, stage + 1):
        own = tables.forced[level, stage - 1, before]
        for j in range(trial.contact.size):
            force = trial.contact[j]
            trial.force[before, j] -= force
            trial.displacement[j] -= own[0, j] * force
            trial.velocity[j] -= own[1, j] * force


@inner_kernel
def modal_contact_force(modes: Modes, trial: Trial) -> None:
    """Write the modal contact force."""
    trial.contact[:] = 0.0
    for i in range(modes.selection.shape[0]):
        force = trial.local.reaction[i]
        for j in range(trial.contact.size):
            trial.contact[j] += modes.selection[i, j] * force
