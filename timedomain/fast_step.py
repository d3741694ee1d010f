"""One step of the fast march: loads, free motion, contact (theory, eqs. 26a, 26b)."""

from __future__ import annotations

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel
from microslip_mechanics.segments import Segments, load_factors
from timedomain.contact_newton import solve_contact
from timedomain.coordinates import Contacts, Modes
from timedomain.coupling import (
    coupled_force,
    extrapolate_coupling,
    renew_coupling,
)
from timedomain.dense import copy, copy_rows
from timedomain.fast_powers import pull, stage_powers
from timedomain.local_motion import Answer
from timedomain.motion import HINT, ITERATIONS, LENGTH, Control, Motion, Trial
from timedomain.tables import Tables

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
            trial.numbers[0] = _stiffness(tables, trial, level)
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
        _middle(modes, segments, motion, trial, begin + 0.5 * length)
    for stage in range(1, tables.times.size):
        part = tables.times[stage] * length
        time = begin + part * EARLIER
        _load(modes, tables, segments, motion, trial, stage, time)
        if tables.mean > 0.0:
            _bulge(modes, trial)
        _predict(modes, tables, motion, trial, level, stage)
        if tables.mean > 0.0:
            _average(contacts, motion, trial, length)
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
        _complete(modes, tables, trial, level, stage)
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
    _load(modes, tables, segments, motion, trial, 0, time)
    if tables.mean == 0.0:
        _contact_force(modes, trial)
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
        tables.scalar[level, stage],
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
        force = DIGITS * size / max(answer.scalar, 1e-300) * answer.stiffness[i, i]
        floor = max(floor, force)
    return floor


@inner_kernel
def _stiffness(tables: Tables, trial: Trial, level: int) -> float:
    """Return contact stiffness times compliance, summed over the points."""
    stage, stiff = tables.times.size - 2, 0.0
    for point in range(trial.before.shape[0]):
        stiff += tables.depth[level, stage, point] * trial.local.by_gap[point, 0]
    return stiff


@inner_kernel
def _load(
    modes: Modes,
    tables: Tables,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    stage: int,
    time: float,
) -> None:
    """Write the modal force of a stage but for contact."""
    load_factors(segments, time, motion.counts[HINT], trial.factors)
    force = trial.force[stage]
    for j in range(force.size):
        force[j] = pull(modes, trial, j)
        force[j] -= coupled_force(trial, j, tables.times[stage], tables.mean > 0.0)


@inner_kernel
def _middle(
    modes: Modes, segments: Segments, motion: Motion, trial: Trial, time: float
) -> None:
    """Write the modal forces of the loads at the middle of a step."""
    load_factors(segments, time, motion.counts[HINT], trial.factors)
    for j in range(trial.bulge.size):
        trial.bulge[j] = pull(modes, trial, j)


@inner_kernel
def _bulge(modes: Modes, trial: Trial) -> None:
    """Add to both ends what the mean load, by Simpson's rule, exceeds their mean by."""
    for j in range(trial.bulge.size):
        ends = 0.5 * (trial.load[j] + pull(modes, trial, j))
        trial.bulge[j] = 2.0 * (trial.bulge[j] - ends) / 3.0
        trial.force[0, j] += trial.bulge[j]
        trial.force[1, j] += trial.bulge[j]


@inner_kernel
def _predict(
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
def _average(contacts: Contacts, motion: Motion, trial: Trial, length: float) -> None:
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
def _contact_force(modes: Modes, trial: Trial) -> None:
    """Write the modal contact force."""
    trial.contact[:] = 0.0
    for i in range(modes.selection.shape[0]):
        force = trial.local.reaction[i]
        for j in range(trial.contact.size):
            trial.contact[j] += modes.selection[i, j] * force


@inner_kernel
def _complete(
    modes: Modes, tables: Tables, trial: Trial, level: int, stage: int
) -> None:
    """Add the contact force to a stage."""
    _contact_force(modes, trial)
    first = 0 if tables.mean > 0.0 else stage
    for before in range(first, stage + 1):
        own = tables.forced[level, stage - 1, before]
        for j in range(trial.contact.size):
            force = trial.contact[j]
            trial.force[before, j] -= force
            trial.displacement[j] -= own[0, j] * force
            trial.velocity[j] -= own[1, j] * force
