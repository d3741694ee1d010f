"""The compiled march of the fast method: a ladder of steps (theory, §7)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.hunt_crossley import normal_force
from microslip_mechanics.contact.law import (
    contact_energy,
    contact_power,
    normal_law,
)
from microslip_mechanics.jit import kernel
from microslip_mechanics.segments import Segments, load_factors, segment_of
from timedomain.contact_newton import Answer, Local, solve_contact
from timedomain.coordinates import Contacts, Modes
from timedomain.point_law import between
from timedomain.record import FLOWS
from timedomain.tables import LEVELS, Tables

TICKS = 2 ** (LEVELS - 1)
"""of the longest step"""
KINK = 12
"""level of the steps that may cross a kink of the load"""
SOONEST = 1e-8
"""of a step: how far behind a kink it begins"""
EARLIER = 1.0 - SOONEST
"""loads at the end of a step are those before a jump at that time"""
DONE, FAILED = -1, -2
TICK, LEVEL, HINT, STEPS, REJECTED, ITERATIONS, SAFE, SAFE_STEPS, ROUGH = range(9)
REFERENCE, DRIFT, LARGEST_DRIFT, OTHER_WORK, LENGTH = range(5)
SAFE_RUN = 32
"""dissipative steps before another linear force is tried"""
STIFF = 4.0
"""largest contact stiffness times compliance of a step with linear force; alone, a
contact coordinate is stable up to 2, and this is a sum over the points"""
GROWTH = 0.08
"""error over tolerance below which the next step is twice as long"""
SHARE = 16.0
"""error over tolerance above which half a step would not do"""


class Control(NamedTuple):
    """What a march is told."""

    longest: float
    """longest step [s]"""
    stride: int
    """longest steps per stored row"""
    tolerance: float
    """of a step's error, relative; 0 holds the longest step"""
    newton: float
    """relative tolerance of contact forces"""
    floor: float
    """absolute one [N]"""
    lowest: int
    """level of the shortest steps"""
    hold: int
    """ticks without a rough step before steps grow"""


class Motion(NamedTuple):
    """What one step hands to the next; written in place."""

    displacement: Array
    """q, shape (modes,)"""
    velocity: Array
    """shape (modes,)"""
    coupled: Array
    """damping force of the other modes, and its rate, shape (2, modes)"""
    gaps: Array
    """of the points [m], shape (points, 3)"""
    slips: Array
    """[m/s], shape (points, 3)"""
    forces: Array
    """[N], at the end of the last step or its mean, shape (points, 3)"""
    rates: Array
    """[N/s], shape (points, 3)"""
    reaction: Array
    """φ [N] and its rate over the last step, shape (2, rank)"""
    relative: Array
    """y and ẏ, shape (2, rank)"""
    powers: Array
    """of FLOWS [W], shape (4,)"""
    energies: Array
    """of FLOWS so far [J], shape (4,)"""
    numbers: Array
    """reference energy, drift of energy by the errors of steps, its largest size,
    friction's discrete work [J]; length of the last step [s]"""
    counts: NDArray[np.int64]
    """tick, level, segment, steps, rejected steps, iterations, dissipative steps to go
    and so far, tick of the last step too rough for a longer one"""


class Trial(NamedTuple):
    """A step that is being tried; workspace."""

    local: Local
    displacement: Array
    velocity: Array
    force: Array
    """modal forces of the stages, shape (stages + 1, modes)"""
    contact: Array
    """modal contact force, shape (modes,)"""
    relative: Array
    """y and ẏ without the stage's contact force, shape (2, rank)"""
    powers: Array
    """of the stages, shape (stages + 1, 4)"""
    factors: Array
    """shape (2,)"""
    before: Array
    """forces of the last stage but one, shape (points, 3)"""
    curvature: Array
    """second derivative of φ, shape (rank,)"""
    numbers: Array
    """contact stiffness times compliance, drift of energy, structural power at the end
    of a step with mean force; shape (3,)"""
    load: Array
    """modal forces of the loads at the begin, shape (modes,)"""
    begins: Array
    """penetrations at the begin, shape (points,)"""


@kernel
def climb(
    control: Control,
    modes: Modes,
    contacts: Contacts,
    tables: tuple[Tables, Tables],
    segments: Segments,
    motion: Motion,
    trial: Trial,
    rows: Array,
    first: int,
) -> tuple[int, int]:
    """March row by row from row ``first`` of ``rows``.

    ``tables`` are those of a step with linear force and those of a dissipative step.

    Returns
    -------
    The rows done, and DONE, FAILED or the level whose tables are wanted; LEVELS is
    added to it where they are those of the dissipative step.
    """
    counts = motion.counts
    for row in range(first, rows.shape[0]):
        end = (counts[TICK] // (control.stride * TICKS) + 1) * control.stride * TICKS
        while counts[TICK] < end:
            level = _level(control, segments, motion)
            safe = counts[SAFE] > 0
            table = tables[1] if safe else tables[0]
            if table.ready[level] == 0.0:
                return row, level + LEVELS * safe
            taken = _attempt(
                control, modes, contacts, table, segments, motion, trial, level
            )
            error = np.inf
            stiff = table.mean == 0.0 and trial.numbers[0] > STIFF
            if taken > 0 and (safe or control.tolerance > 0.0 or not stiff):
                error = _error(control, modes, table, motion, trial, level, safe)
            if error > 1.0:
                counts[REJECTED] += 1
                counts[ROUGH] = counts[TICK]
                if safe or (error <= SHARE and not stiff):
                    level += 1
                else:
                    counts[SAFE] = SAFE_RUN
                if level > control.lowest:
                    return row, FAILED
                counts[LEVEL] = level
                continue
            _accept(control, modes, contacts, table, motion, trial, level)
            counts[LEVEL] = level
            if safe:
                counts[SAFE] -= 1
                counts[SAFE_STEPS] += 1
            if error > GROWTH:
                counts[ROUGH] = counts[TICK]
            elif counts[TICK] - counts[ROUGH] > control.hold:
                counts[LEVEL] = max(0, level - 1)
                counts[ROUGH] = counts[TICK]
        _store(modes, contacts, motion, rows[row])
    return rows.shape[0], DONE


@kernel
def _level(control: Control, segments: Segments, motion: Motion) -> int:
    """Return the level of the next step: on the ladder's grid, not across a kink."""
    counts = motion.counts
    level, tick = counts[LEVEL], counts[TICK]
    while tick % (TICKS >> level) != 0:
        level += 1
    begin, length = _time(control, tick), control.longest / 2.0**level
    counts[HINT] = segment_of(segments, begin + SOONEST * length, counts[HINT])
    place = counts[HINT] + 1
    if place < segments.begin.size:
        while level < KINK and begin + length > segments.begin[place] + 0.01 * length:
            level, length = level + 1, 0.5 * length
    return int(level)


@kernel
def _time(control: Control, tick: int) -> float:
    return control.longest * (tick / TICKS)


@kernel
def _attempt(
    control: Control,
    modes: Modes,
    contacts: Contacts,
    tables: Tables,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    level: int,
) -> int:
    """Try a step; return Newton's iterations, or −1."""
    length = control.longest / 2.0**level
    begin = _time(control, motion.counts[TICK])
    stages = tables.times.size - 1
    trial.local.reaction[:] = motion.reaction[0]
    _load(modes, segments, motion, trial, 0, begin + SOONEST * length, 0.0)
    if tables.mean == 0.0:
        _contact_force(modes, trial)
        trial.force[0] -= trial.contact
    trial.powers[0] = motion.powers
    _input_power(modes, trial, motion.velocity, 0)
    for j in range(trial.load.size):
        trial.load[j] = trial.factors[0] * modes.loads[0, j]
        trial.load[j] += trial.factors[1] * modes.loads[1, j]
    iterations = 0
    for stage in range(1, stages + 1):
        part = tables.times[stage] * length
        _load(modes, segments, motion, trial, stage, begin + part * EARLIER, part)
        _predict(modes, tables, motion, trial, level, stage)
        if tables.mean > 0.0:
            _average(contacts, motion, trial, length)
            part = 0.5 * (length + motion.numbers[LENGTH])
        if stage == stages:
            trial.before[:] = trial.local.forces
        for point in range(contacts.first.size):
            for axis in range(3):
                trial.local.forces[point, axis] = (
                    motion.forces[point, axis] + part * motion.rates[point, axis]
                )
        answer = Answer(
            tables.compliance[level, stage - 1],
            tables.stiffness[level, stage - 1],
            tables.slope[level, stage - 1],
            tables.scalar[level, stage - 1],
            tables.weight[level, stage - 1],
            trial.begins if tables.mean > 0.0 else trial.begins[:0],
        )
        taken = solve_contact(
            contacts,
            answer,
            trial.relative[0],
            trial.relative[1],
            trial.local,
            control.newton,
            control.floor,
        )
        if taken < 0:
            return -1
        iterations += taken
        _complete(modes, tables, trial, level, stage)
        _powers(
            modes, contacts, tables, motion, trial, stage, tables.times[stage] * length
        )
    motion.counts[ITERATIONS] += iterations
    stiff = 0.0
    for point in range(contacts.first.size):
        stiff += tables.depth[level, stages - 1, point] * trial.local.by_gap[point, 0]
    trial.numbers[0] = stiff
    return max(1, iterations)


@kernel
def _load(
    modes: Modes,
    segments: Segments,
    motion: Motion,
    trial: Trial,
    stage: int,
    time: float,
    part: float,
) -> None:
    """Write the modal force of a stage but for contact."""
    load_factors(segments, time, motion.counts[HINT], trial.factors)
    one, two = trial.factors[0], trial.factors[1]
    force = trial.force[stage]
    for j in range(force.size):
        force[j] = one * modes.loads[0, j] + two * modes.loads[1, j]
        force[j] -= motion.coupled[0, j] + part * motion.coupled[1, j]


@kernel
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
    trial.relative[:] = 0.0
    for j in range(moved.size):
        q, v = moved[j], moving[j]
        for i in range(modes.seen.shape[1]):
            trial.relative[0, i] += modes.seen[j, i] * q
            trial.relative[1, i] += modes.seen[j, i] * v


@kernel
def _average(
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


@kernel
def _contact_force(modes: Modes, trial: Trial) -> None:
    """Write the modal contact force."""
    trial.contact[:] = 0.0
    for i in range(modes.selection.shape[0]):
        force = trial.local.reaction[i]
        for j in range(trial.contact.size):
            trial.contact[j] += modes.selection[i, j] * force


@kernel
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


@kernel
def _input_power(modes: Modes, trial: Trial, velocity: Array, stage: int) -> None:
    one, two = trial.factors[0], trial.factors[1]
    power = 0.0
    for j in range(velocity.size):
        power += (one * modes.loads[0, j] + two * modes.loads[1, j]) * velocity[j]
    trial.powers[stage, 0] = power


@kernel
def _powers(
    modes: Modes,
    contacts: Contacts,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    stage: int,
    part: float,
) -> None:
    """Write the powers of a stage."""
    _input_power(modes, trial, trial.velocity, stage)
    friction, damping = 0.0, 0.0
    local = trial.local
    for point in range(contacts.first.size):
        slid, damped = contact_power(
            contacts.points, point, local.gaps[point], local.slips[point],
            local.forces[point],
        )
        friction += slid
        damping += damped
        if tables.mean > 0.0:
            more = between(
                normal_law(contacts.points, point),
                trial.begins[point],
                local.gaps[point, 0],
            )
            damping -= more[0] * local.slips[point, 0]
    lost = 0.0
    for j in range(trial.velocity.size):
        v = trial.velocity[j]
        lost += v * (modes.damping[j] * v)
        lost += v * (motion.coupled[0, j] + part * motion.coupled[1, j])
    trial.powers[stage, 1], trial.powers[stage, 2] = friction, damping
    trial.powers[stage, 3] = lost
    if tables.mean > 0.0:
        trial.powers[1, 3] = 0.5 * (lost + motion.powers[3])
        trial.numbers[2] = lost
        _mean_input(modes, motion, trial, part)


@kernel
def _mean_input(modes: Modes, motion: Motion, trial: Trial, length: float) -> None:
    """Write the mean power of loads that are linear over the step.

    With a cubic between the modal motions of its ends it is p̄ Δq/h + Δp Δq̇/12.
    """
    one, two = trial.factors[0], trial.factors[1]
    power = 0.0
    for j in range(trial.velocity.size):
        begin = trial.load[j]
        end = one * modes.loads[0, j] + two * modes.loads[1, j]
        moved = trial.displacement[j] - motion.displacement[j]
        faster = trial.velocity[j] - motion.velocity[j]
        power += 0.5 * (begin + end) * moved / length + (end - begin) * faster / 12.0
    trial.powers[1, 0] = power


@kernel
def _error(
    control: Control,
    modes: Modes,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    level: int,
    safe: bool,
) -> float:
    """Return the error of the step over the tolerance; 0 if steps have one length."""
    length = control.longest / 2.0**level
    now = 0.0
    for j in range(motion.velocity.size):
        q, v = motion.displacement[j], motion.velocity[j]
        now += v**2 + modes.stiffness[j] * q**2
    reference = max(motion.numbers[REFERENCE], now)
    motion.numbers[REFERENCE] = reference
    if safe:
        energy = _embedded(modes, tables, motion, trial, level)
    else:
        energy = _curvature(modes, motion, trial, length)
    if control.tolerance == 0.0:
        return 0.0
    return float(np.sqrt(energy / reference) / control.tolerance)


@kernel
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
    trial.numbers[1] = drift
    return energy


@kernel
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
    trial.numbers[1] = drift
    return energy


@kernel
def _accept(
    control: Control,
    modes: Modes,
    contacts: Contacts,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    level: int,
) -> None:
    """Take over a step that was tried."""
    length = control.longest / 2.0**level
    stages = tables.times.size - 1
    local, last = trial.local, (1.0 - tables.times[stages - 1]) * length
    if stages == 1:
        trial.before[:] = motion.forces
    if tables.mean > 0.0:
        last = 0.5 * (length + motion.numbers[LENGTH])
    _follow(contacts, tables, motion, trial, level, length)
    for point in range(contacts.first.size):
        for axis in range(3):
            force = local.forces[point, axis]
            motion.rates[point, axis] = (force - trial.before[point, axis]) / last
            motion.forces[point, axis] = force
            motion.slips[point, axis] = local.slips[point, axis]
    for flow in range(len(FLOWS)):
        for stage in range(stages + 1):
            work = length * trial.powers[stage, flow]
            motion.energies[flow] += tables.work[stage] * work
        motion.powers[flow] = trial.powers[stages, flow]
    if tables.mean > 0.0:
        motion.powers[3] = trial.numbers[2]
    motion.displacement[:] = trial.displacement
    motion.velocity[:] = trial.velocity
    for i in range(local.reaction.size):
        force = local.reaction[i]
        motion.reaction[1, i] = (force - motion.reaction[0, i]) / length
        motion.reaction[0, i] = force
    motion.numbers[LENGTH] = length
    motion.numbers[DRIFT] += trial.numbers[1]
    drift = abs(motion.numbers[DRIFT])
    motion.numbers[LARGEST_DRIFT] = max(motion.numbers[LARGEST_DRIFT], drift)
    _couple(modes, motion, trial, length)
    motion.counts[TICK] += TICKS >> level
    motion.counts[STEPS] += 1


@kernel
def _follow(
    contacts: Contacts,
    tables: Tables,
    motion: Motion,
    trial: Trial,
    level: int,
    length: float,
) -> None:
    """Renew the relative motion; add friction's work by the other of two ways.

    It is the mean force times the sliding increment, or where that is the energy
    already, the mean force times the mean velocity.
    """
    local, begin = trial.local, trial.relative
    rank = local.velocity.size
    for i in range(rank):
        begin[0, i], begin[1, i] = motion.relative[0, i], motion.relative[1, i]
        if tables.mean > 0.0:
            motion.relative[0, i] += length * local.velocity[i]
            motion.relative[1, i] = trial.curvature[i]
        else:
            motion.relative[0, i] = local.displacement[i]
            motion.relative[1, i] = local.velocity[i]
    if tables.mean > 0.0:
        for j in range(rank):
            for i in range(rank):
                motion.relative[1, i] -= tables.swing[level, j, i] * local.reaction[j]
    for point in range(contacts.first.size):
        first = contacts.first[point]
        for axis in range(1, 3):
            force, slid = local.forces[point, axis], 0.0
            if tables.mean == 0.0:
                force = 0.5 * (force + motion.forces[point, axis])
            for i in range(contacts.width[point]):
                each = first + i
                if tables.mean > 0.0:
                    moved = motion.relative[1, each] + begin[1, each]
                    moved *= 0.5 * length
                else:
                    moved = motion.relative[0, each] - begin[0, each]
                slid += contacts.basis[point, axis, i] * moved
            motion.numbers[OTHER_WORK] += force * slid


@kernel
def _couple(modes: Modes, motion: Motion, trial: Trial, length: float) -> None:
    """Renew the damping force of the other modes, and its rate."""
    fresh = trial.contact
    fresh[:] = 0.0
    for i in range(fresh.size):
        v = motion.velocity[i]
        for j in range(modes.reach[i, 0], modes.reach[i, 1]):
            fresh[j] += modes.coupling[i, j] * v
    for j in range(fresh.size):
        motion.coupled[1, j] = (fresh[j] - motion.coupled[0, j]) / length
        motion.coupled[0, j] = fresh[j]


@kernel
def _store(modes: Modes, contacts: Contacts, motion: Motion, row: Array) -> None:
    """Write a row like :func:`timedomain.record.store`, and what errors there are."""
    probes, count = modes.probes.shape[0], contacts.first.size
    row[:] = 0.0
    kinetic, elastic, stored = 0.0, 0.0, 0.0
    for j in range(motion.velocity.size):
        q, v = motion.displacement[j], motion.velocity[j]
        for probe in range(probes):
            row[probe] += modes.probes[probe, j] * q
            row[probes + probe] += modes.probes[probe, j] * v
        kinetic += 0.5 * v * v
        elastic += 0.5 * modes.stiffness[j] * q * q
    place = 2 * probes
    for point in range(count):
        first, gap = contacts.first[point], 0.0
        for i in range(contacts.width[point]):
            gap += contacts.basis[point, 0, i] * motion.relative[0, first + i]
        motion.gaps[point, 0] = gap
        law = normal_law(contacts.points, point)
        row[place + point], _, _ = normal_force(law, gap, motion.slips[point, 0])
        stored += contact_energy(contacts.points, point, gap)
    place += count
    row[place] = motion.powers[1]
    row[place + 1 : place + 5] = motion.energies
    row[place + 5], row[place + 6], row[place + 7] = kinetic, elastic, stored
    row[place + 8 : place + 12] = motion.numbers[:4]
