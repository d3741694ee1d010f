"""Taking over a step of the fast march that was tried."""

from __future__ import annotations

from microslip_mechanics.jit import bare_kernel, inner_kernel
from timedomain.contact.dense import copy, copy_rows
from timedomain.fast.coordinates import Contacts
from timedomain.fast.coupling import accept_coupling
from timedomain.fast.motion import (
    DRIFT,
    LARGEST_DRIFT,
    LENGTH,
    OTHER_WORK,
    REFERENCE,
    SETTLED_DRIFT,
    UNKEPT,
    Control,
    Motion,
    Trial,
)
from timedomain.fast.tables import Tables


@bare_kernel
def accept(
    contacts: Contacts,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    level: int,
    length: float,
) -> None:
    """Take over a step that was tried."""
    copy_rows(motion.relative, trial.relative)
    _renew_relative(tables, motion, trial, level, length)
    motion.numbers[OTHER_WORK] += _other_work(contacts, tables, motion, trial, length)
    _renew_forces(tables, motion, trial, length)
    _renew_energies(tables, motion, trial, length)
    copy(trial.displacement, motion.displacement)
    copy(trial.velocity, motion.velocity)
    motion.numbers[LENGTH] = length
    motion.numbers[DRIFT] += trial.numbers[0]
    drift = abs(motion.numbers[DRIFT] - motion.numbers[SETTLED_DRIFT])
    motion.numbers[LARGEST_DRIFT] = max(motion.numbers[LARGEST_DRIFT], drift)
    accept_coupling(motion, trial, length)


@inner_kernel
def tell_error(motion: Motion, trial: Trial) -> None:
    """Count the error of a step that cannot keep the tolerance, whatever its sign."""
    motion.numbers[UNKEPT] += abs(trial.numbers[0]) + 0.5 * trial.numbers[2]


@inner_kernel
def settle(control: Control, motion: Motion) -> None:
    """Forget how fast the preload grew: what it moved says nothing of later motion."""
    motion.numbers[REFERENCE] = control.least
    motion.numbers[SETTLED_DRIFT] = motion.numbers[DRIFT]
    motion.numbers[LARGEST_DRIFT] = 0.0


@inner_kernel
def _renew_relative(
    tables: Tables, motion: Motion, trial: Trial, level: int, length: float
) -> None:
    """Write the relative motion at the end."""
    local = trial.local
    if tables.mean == 0.0:
        copy(local.displacement, motion.relative[0])
        copy(local.velocity, motion.relative[1])
        return
    rank = local.velocity.size
    for i in range(rank):
        motion.relative[0, i] += length * local.velocity[i]
        motion.relative[1, i] = trial.curvature[i]
    for j in range(rank):
        for i in range(rank):
            motion.relative[1, i] -= tables.swing[level, j, i] * local.reaction[j]


@inner_kernel
def _other_work(
    contacts: Contacts, tables: Tables, motion: Motion, trial: Trial, length: float
) -> float:
    """Return friction's work over the step by the other of two ways.

    It is the mean force times the sliding increment, or where that is the energy
    already, the mean force times the mean velocity.
    """
    work, old, new = 0.0, trial.relative, motion.relative
    for point in range(contacts.first.size):
        for axis in range(1, 3):
            slid = 0.0
            for i in range(contacts.width[point]):
                each = contacts.first[point] + i
                moved = new[0, each] - old[0, each]
                if tables.mean > 0.0:
                    moved = 0.5 * length * (new[1, each] + old[1, each])
                slid += contacts.basis[point, axis, i] * moved
            force = trial.local.forces[point, axis]
            if tables.mean == 0.0:
                force = 0.5 * (force + motion.forces[point, axis])
            work += force * slid
    return work


@inner_kernel
def _renew_forces(tables: Tables, motion: Motion, trial: Trial, length: float) -> None:
    """Write forces and their rates."""
    local = trial.local
    last = (1.0 - tables.times[tables.times.size - 2]) * length
    if tables.mean > 0.0:
        last = 0.5 * (length + motion.numbers[LENGTH])
    for point in range(motion.forces.shape[0]):
        for axis in range(3):
            force = local.forces[point, axis]
            motion.rates[point, axis] = (force - trial.before[point, axis]) / last
            motion.forces[point, axis] = force
            motion.slips[point, axis] = local.slips[point, axis]
    for i in range(local.reaction.size):
        force = local.reaction[i]
        motion.reaction[1, i] = (force - motion.reaction[0, i]) / length
        motion.reaction[0, i] = force


@inner_kernel
def _renew_energies(
    tables: Tables, motion: Motion, trial: Trial, length: float
) -> None:
    """Add the work of the step to the energies."""
    stages = tables.times.size
    for flow in range(motion.energies.size):
        for stage in range(stages):
            work = length * trial.powers[stage, flow]
            motion.energies[flow] += tables.work[stage] * work
        motion.powers[flow] = trial.powers[stages - 1, flow]
    if tables.mean > 0.0:
        motion.powers[3] = trial.numbers[1]
