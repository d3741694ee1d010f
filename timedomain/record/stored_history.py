"""What a march has stored, as a time history."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.record.record import FLOWS, STORES


def stored_history(
    problem: Problem,
    times: Array,
    rows: Array,
    *,
    stored_at_start: float,
    step: float,
    iterations: int,
    divided: int,
    checkpoint: Checkpoint,
) -> TimeHistory:
    """Return a history of rows written by :func:`timedomain.record.record.store`."""
    probes, contacts = problem.probes.names, problem.interface.names
    cuts = np.cumsum([len(probes), len(probes), len(contacts), 1])
    shown, moving, normal, power, energy = np.split(rows, cuts, axis=1)
    return TimeHistory(
        times,
        probes,
        shown,
        moving,
        contacts,
        normal,
        power[:, 0],
        (*FLOWS, *STORES),
        energy,
        stored_at_start,
        step,
        iterations,
        divided,
        checkpoint=checkpoint,
    )
