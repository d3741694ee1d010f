"""Cycles of a march, as the rows of its envelope."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.segments import Segments, clock
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.time_history import TimeHistory

LAST, HIGHEST, LOWEST = 0, 1, 2
"""which row of a cycle a column keeps"""
FLOOR = 1e-6
"""of a cycle: a row so little behind its end still belongs to it"""


def enveloped(
    blocks: Iterable[TimeHistory], segments: Segments, begun: Array | None = None
) -> Iterator[Envelope]:
    """Yield, block by block, the envelope over the cycles that end in it.

    Parameters
    ----------
    blocks
        Of one march; the rows should be dense, as extremes lie between them.
    segments
        The loads, whose phase counts the cycles.
    begun
        The cycle that a stopped march had begun, as :func:`parted` returns it.

    The last cycle, which the end may cut off, comes by itself. Blocks before the end of
    the first cycle come with it: without a row nobody sees what a march tells.
    """
    block, waits = None, True
    before = (0, 0)
    for each in blocks:
        block = _behind(each, before)
        table, kept = _table(block, segments)
        if begun is not None:
            table = np.concatenate([begun[None], table])
        cycles = _reduced(table, kept)
        begun = cycles[-1]
        waits = waits and len(cycles) == 1
        before = (block.iterations, block.divided) if waits else (0, 0)
        if not waits:
            yield _envelope(cycles[:-1], block, _with(block.checkpoint, begun))
    if block is not None and begun is not None:
        rest = replace(block, iterations=before[0], divided=before[1])
        yield _envelope(begun[None], rest, _with(block.checkpoint, begun))


def _behind(block: TimeHistory, before: tuple[int, int]) -> TimeHistory:
    """Return a block with the work of those before it, iterations and divided steps."""
    iterations, divided = before
    return replace(
        block, iterations=block.iterations + iterations, divided=block.divided + divided
    )


def parted(checkpoint: Checkpoint) -> tuple[Checkpoint, Array]:
    """Return the march's own checkpoint and the cycle that was begun."""
    memory = checkpoint.memory
    size = int(memory[-1])
    own = replace(checkpoint, memory=memory[: -size - 1])
    return own, memory[-size - 1 : -1]


def _with(checkpoint: Checkpoint | None, begun: Array) -> Checkpoint | None:
    """Return a checkpoint that also knows the cycle that was begun."""
    if checkpoint is None:
        return None
    memory = np.concatenate([checkpoint.memory, begun, [begun.size]])
    return replace(checkpoint, memory=memory)


def _table(block: TimeHistory, segments: Segments) -> tuple[Array, Array]:
    """Return a block's rows, each with its cycle in front, and what is kept of each."""
    sine = clock(segments, block.time)
    cycle = np.ceil(sine[:, 2] / (2.0 * np.pi) - FLOOR)
    moved, normal = block.displacement, block.normal_force
    parts = (
        (LAST, np.stack([cycle, block.time, sine[:, 0], sine[:, 1]], axis=1)),
        (HIGHEST, moved),
        (LOWEST, moved),
        (HIGHEST, np.abs(block.velocity)),
        (LOWEST, normal),
        (HIGHEST, normal),
        (LAST, block.energy),
        *((LAST, getattr(block, name)[:, None]) for name in _told(block)),
    )
    kept = np.concatenate([np.full(part.shape[1], kind) for kind, part in parts])
    return np.concatenate([part for _, part in parts], axis=1), kept


def _told(block: TimeHistory) -> list[str]:
    """Return the estimates that a march has."""
    names = ("energy_error", "peak_error", "work_difference")
    return [name for name in names if getattr(block, name).size]


def _reduced(table: Array, kept: Array) -> Array:
    """Return one row for each cycle."""
    starts = np.flatnonzero(np.diff(table[:, 0], prepend=table[0, 0] - 1.0))
    high = np.maximum.reduceat(table, starts, axis=0)
    low = np.minimum.reduceat(table, starts, axis=0)
    last = table[np.append(starts[1:], len(table)) - 1]
    return np.where(kept == HIGHEST, high, np.where(kept == LOWEST, low, last))


def _envelope(
    cycles: Array, block: TimeHistory, checkpoint: Checkpoint | None
) -> Envelope:
    probes, contacts = len(block.probes), len(block.contacts)
    energies, told = len(block.energies), _told(block)
    cuts = np.cumsum([4, probes, probes, probes, contacts, contacts, energies])
    clocks, high, low, fast, least, most, energy, errors = np.split(
        cycles, cuts, axis=1
    )
    return Envelope(
        clocks[:, 1],
        clocks[:, 2],
        clocks[:, 3],
        block.probes,
        high,
        low,
        fast,
        block.contacts,
        least,
        most,
        block.energies,
        energy,
        block.stored_at_start,
        block.time_step,
        block.iterations,
        block.divided,
        block.ending,
        checkpoint,
        **dict(zip(told, errors.T, strict=True)),
    )
