"""The compiled march of the fast method: a ladder of steps (theory, §7.2)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.normal import contact_energy, normal_response
from microslip_mechanics.jit import bare_kernel, inner_kernel
from microslip_mechanics.loads.segments import Segments, segment_of
from timedomain.fast.accept import accept, settle, tell_error
from timedomain.fast.coordinates import Contacts, Modes
from timedomain.fast.fast_step import SOONEST, attempt
from timedomain.fast.motion import (
    HINT,
    HOPELESS,
    LEVEL,
    ROUGH,
    SAFE,
    SAFE_STEPS,
    STEPS,
    TICK,
    WORST,
    Control,
    Motion,
    Trial,
)
from timedomain.fast.rejection import SHARE, WELL, reject, tried_enough
from timedomain.fast.step_error import step_error
from timedomain.fast.tables import LEVELS, Tables

TICKS = 2 ** (LEVELS - 1)
"""of the longest step"""
KINK = 12
"""level of the steps that may cross a kink of the load"""
DONE, FAILED = -1, -2
GROWTH = 0.08
"""error over tolerance below which the next step is twice as long"""
MOST = 4096
"""steps without a rough one after which the next is longer, if that comes sooner"""


@bare_kernel
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

    ``tables`` are those of the method's step and those of a dissipative step.

    Returns
    -------
    The rows done, and DONE, FAILED or the level whose tables are wanted; LEVELS is
    added to it where they are those of the dissipative step.
    """
    ticks = control.stride * TICKS
    for row in range(first, rows.shape[0]):
        end = (motion.counts[TICK] // ticks + 1) * ticks
        while motion.counts[TICK] < end:
            status = _step(control, modes, contacts, tables, segments, motion, trial)
            if status != DONE:
                return row, status
        _store(modes, contacts, motion, rows[row])
    return rows.shape[0], DONE


@inner_kernel
def _step(
    control: Control,
    modes: Modes,
    contacts: Contacts,
    tables: tuple[Tables, Tables],
    segments: Segments,
    motion: Motion,
    trial: Trial,
) -> int:
    """Try a step and take or reject it."""
    counts = motion.counts
    level = _level(control, segments, motion)
    safe = counts[SAFE] > 0
    table = tables[1] if safe else tables[0]
    if table.ready[level] == 0.0:
        return int(level + LEVELS * safe)
    begin = _time(control, counts[TICK])
    taken = attempt(
        control, modes, contacts, table, segments, motion, trial, level, begin
    )
    length, error = control.longest / 2.0**level, np.inf
    if taken > 0:
        error = step_error(control, modes, table, motion, trial, level, safe)
    kept = error <= 1.0
    if not kept and not tried_enough(control, motion, level, error):
        nearly = taken == 0 or error <= SHARE
        return DONE if reject(control, motion, level, nearly) else FAILED
    accept(contacts, table, motion, trial, level, length)
    if not kept:
        tell_error(motion, trial)
    elif level <= WELL:
        counts[HOPELESS] = 0
    if counts[TICK] < control.settled <= counts[TICK] + (TICKS >> level):
        settle(control, motion)
    counts[TICK] += TICKS >> level
    counts[STEPS] += 1
    if safe:
        counts[SAFE] -= 1
        counts[SAFE_STEPS] += 1
    motion.numbers[WORST] = 0.0
    _grow(control, motion, level, error)
    return DONE


@inner_kernel
def _grow(control: Control, motion: Motion, level: int, error: float) -> None:
    """Let the next step be twice as long if none was rough for long enough."""
    counts = motion.counts
    if level > counts[LEVEL]:
        return  # shortened for the grid or a kink of the load: that says nothing
    if error > GROWTH:
        counts[ROUGH] = counts[TICK]
    elif (
        level > 0
        and counts[TICK] - counts[ROUGH] > min(control.hold, MOST * (TICKS >> level))
        and counts[TICK] % (TICKS >> (level - 1)) == 0  # where a longer one may begin
    ):
        counts[LEVEL] = level - 1
        counts[ROUGH] = counts[TICK]


@inner_kernel
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


@inner_kernel
def _time(control: Control, tick: int) -> float:
    return float(control.longest * (tick / TICKS))


@inner_kernel
def _store(modes: Modes, contacts: Contacts, motion: Motion, row: Array) -> None:
    """Write a row like :func:`~timedomain.record.record.store`, with its errors."""
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
        first, gap, approach = contacts.first[point], 0.0, 0.0
        for i in range(contacts.width[point]):
            gap += contacts.basis[point, 0, i] * motion.relative[0, first + i]
            approach += contacts.basis[point, 0, i] * motion.relative[1, first + i]
        motion.gaps[point, 0] = gap
        row[place + point], _, _ = normal_response(
            contacts.points, point, gap, approach
        )
        stored += contact_energy(contacts.points, point, gap)
    place += count
    row[place] = motion.powers[1]
    for flow in range(motion.energies.size):
        row[place + 1 + flow] = motion.energies[flow]
    row[place + 5], row[place + 6], row[place + 7] = kinetic, elastic, stored
    for number in range(5):
        row[place + 8 + number] = motion.numbers[number]
