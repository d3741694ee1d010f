"""One step of the fast march: loads, free motion, contact (theory, eqs. 26a, 26b)."""

from __future__ import annotations

from microslip_mechanics.arrays import TINY
from microslip_mechanics.jit import bare_kernel, inner_kernel
from microslip_mechanics.loads.segments import Segments
from timedomain.contact.dense import copy, copy_rows
from timedomain.contact.local_motion import Answer
from timedomain.fast.contact_newton import solve_contact
from timedomain.fast.coordinates import Contacts, Modes
from timedomain.fast.coupling import extrapolate_coupling, renew_coupling
from timedomain.fast.fast_powers import pull, stage_powers
from timedomain.fast.motion import ITERATIONS, LENGTH, Control, Motion, Trial
from timedomain.fast.stage_load import middle_load, share_bulge, stage_load
from timedomain.fast.stage_motion import (
    average_stage,
    complete_stage,
    modal_contact_force,
    predict_stage,
)
from timedomain.fast.tables import Tables

SOONEST = 1e-8
"""of a step: how far behind a kink it begins"""
COUPLINGS = 12
"""tries of a step until the coupling forces at its end are those of its motion"""
DEEP = 12
"""level from which on steps are so short that rounding shows"""
DIGITS = 4e-15
"""relative error of displacements by rounding"""
EARLIER = 1.0 - SOONEST
"""loads at the end of a step are those before a jump at that time"""


@bare_kernel
def attempt(
    control: Control,
    modes: Modes,
    contacts: Contacts,
    tables: Tables,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    level: int,
    begin: float,
) -> int:
    """Try a step from the time ``begin``; return Newton's iterations.

    They are −1 where Newton's method does not converge, and 0 where damping between
    modes is too strong for so long a step.
    """
    length, iterations = control.longest / 2.0**level, 0
    extrapolate_coupling(motion, trial, length)
    for _ in range(COUPLINGS):
        taken = _stages(
            control, modes, contacts, tables, segments, motion, trial, level, begin
        )
        if taken < 0:
            return -1
        iterations += taken
        if renew_coupling(modes, motion, trial, length) <= control.newton:
            motion.counts[ITERATIONS] += iterations
            return max(1, iterations)
    return 0


@inner_kernel
def _stages(
    control: Control,
    modes: Modes,
    contacts: Contacts,
    tables: Tables,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    level: int,
    begin: float,
) -> int:
    """Try a step with the coupling forces that are guessed."""
    length = control.longest / 2.0**level
    _begin(modes, tables, segments, motion, trial, begin + SOONEST * length)
    iterations = 0
    if tables.mean > 0.0:
        middle_load(modes, segments, motion, trial, begin + 0.5 * length)
    for stage in range(1, tables.times.size):
        part = tables.times[stage] * length
        time = begin + part * EARLIER
        stage_load(modes, tables, segments, motion, trial, stage, time)
        if tables.mean > 0.0:
            share_bulge(modes, trial)
        predict_stage(modes, tables, motion, trial, level, stage)
        if tables.mean > 0.0:
            average_stage(contacts, motion, trial, length)
            _guess(motion, trial, 0.5 * (length + motion.numbers[LENGTH]))
        else:
            _guess(motion, trial, part)
        answer = _answer(tables, trial, level, stage - 1)
        taken = solve_contact(
            contacts,
            answer,
            trial.relative[0],
            trial.relative[1],
            trial.local,
            control.newton,
            control.floor if level < DEEP else _floor(control, modes, answer, motion),
        )
        if taken < 0:
            return -1
        iterations += taken
        complete_stage(modes, tables, trial, level, stage)
        stage_powers(modes, contacts, tables, motion, trial, stage, part)
    return iterations


@inner_kernel
def _begin(
    modes: Modes,
    tables: Tables,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    time: float,
) -> None:
    """Write forces and powers at the begin of a step."""
    copy(motion.reaction[0], trial.local.reaction)
    copy_rows(motion.forces, trial.local.forces)
    stage_load(modes, tables, segments, motion, trial, 0, time)
    if tables.mean == 0.0:
        modal_contact_force(modes, trial)
        for j in range(trial.contact.size):
            trial.force[0, j] -= trial.contact[j]
    copy(motion.powers, trial.powers[0])
    for j in range(trial.load.size):
        trial.load[j] = pull(modes, trial, j)


@inner_kernel
def _guess(motion: Motion, trial: Trial, ahead: float) -> None:
    """Extrapolate the forces of the points; keep those of the stage before."""
    for point in range(motion.forces.shape[0]):
        for axis in range(3):
            trial.before[point, axis] = trial.local.forces[point, axis]
            trial.local.forces[point, axis] = (
                motion.forces[point, axis] + ahead * motion.rates[point, axis]
            )


@inner_kernel
def _answer(tables: Tables, trial: Trial, level: int, stage: int) -> Answer:
    """Return what Newton's method needs of a stage."""
    return Answer(
        tables.compliance[level, stage],
        tables.stiffness[level, stage],
        tables.slope[level, stage],
        tables.weight[level, stage],
        trial.begins if tables.mean > 0.0 else trial.begins[:0],
    )


@inner_kernel
def _floor(control: Control, modes: Modes, answer: Answer, motion: Motion) -> float:
    """Return the unbalanced force [N] that rounding leaves in a short step.

    It changes displacements, whose difference over the step is a velocity, by which
    friction that sticks changes as the compliance tells.
    """
    floor = control.floor
    for i in range(modes.selection.shape[0]):
        size = 0.0
        for j in range(motion.displacement.size):
            size += abs(modes.selection[i, j] * motion.displacement[j])
        # compliance is that of the mean velocity: half the step makes displacements
        force = DIGITS * size / max(answer.slope, TINY) * answer.stiffness[i, i]
        floor = max(floor, force)
    return floor
