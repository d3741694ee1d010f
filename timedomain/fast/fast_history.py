"""What the fast march has stored, as a time history with its estimated errors."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import rubs
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.fast.motion import DRIFT, LARGEST_DRIFT, OTHER_WORK, REFERENCE, UNKEPT
from timedomain.record.record import row_length
from timedomain.record.stored_history import stored_history

NUMBERS = 5
"""that a row holds behind the energies"""
CANCELLED = 4.0
"""by which errors exceed their sum, whose signs cancel: at most that on eight rigs"""


def empty_rows(problem: Problem, count: int) -> Array:
    """Return room for so many stored rows."""
    probes, points = len(problem.probes.names), problem.interface.count
    return np.empty((count, row_length(probes, points) + NUMBERS))


def fast_history(
    problem: Problem,
    times: Array,
    rows: Array,
    *,
    stored_at_start: float,
    step: float,
    iterations: int,
    rejected: int,
    tolerance: float | None,
    checkpoint: Checkpoint,
) -> TimeHistory:
    """Return the history of a block; see :class:`TimeHistory` for what it holds."""
    length = row_length(len(problem.probes.names), problem.interface.count)
    stored, more = np.split(rows, [length], axis=1)
    history = stored_history(
        problem,
        times,
        stored,
        stored_at_start=stored_at_start,
        step=step,
        iterations=iterations,
        divided=0 if tolerance else rejected,
        checkpoint=checkpoint,
    )
    difference = history.of("friction") - more[:, OTHER_WORK]
    history = replace(history, work_difference=difference)
    if tolerance is None:
        return history
    return _estimated(history, more, tolerance, friction=rubs(problem.interface.points))


def _estimated(
    history: TimeHistory, more: Array, least: float, *, friction: bool
) -> TimeHistory:
    """Return a history with estimated errors, none below the tolerance.

    The work of the steps' errors is that of all contacts: without friction, that of
    its energy, which is zero, is none.
    """
    drift, unkept = np.abs(more[:, DRIFT]), more[:, UNKEPT]
    drift = CANCELLED * (drift + np.abs(history.work_difference)) + unkept
    lost = (more[:, LARGEST_DRIFT] + unkept) / more[:, REFERENCE]
    energy = np.maximum(drift, least * np.abs(history.of("friction")))
    return replace(
        history,
        energy_error=energy if friction else np.zeros(len(energy)),
        peak_error=np.maximum(lost, least),
    )
