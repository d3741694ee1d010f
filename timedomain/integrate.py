"""The public function: a problem and a load history to blocks of a time history."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

from microslip_mechanics.contact.memory import beyond_motion
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.fast.fast import FastMarch
from timedomain.options import IntegrationError, MarchOptions
from timedomain.record.start import Start, at_rest
from timedomain.reference.reference import ReferenceMarch
from timedomain.step_doubling import StepDoubling, rows_between

__all__ = ["IntegrationError", "MarchOptions", "integrate"]

BLOCK, ROWS = 0.1, 10**5
"""length [s] and rows of a block, at most, if none is given"""
ROUNDING = 1e-12
"""of a number of steps, relative: a march of whole periods has no step more"""


def integrate(
    problem: Problem,
    history: LoadHistory,
    options: MarchOptions,
    *,
    start: Start | Checkpoint | None = None,
    block: float | None = None,
) -> Iterator[TimeHistory]:
    """Yield the response to a load history, block by block.

    Parameters
    ----------
    problem
        What is integrated.
    history
        Factors of preload and drive over time.
    options
        Method, step or tolerance, and what is stored. Contacts that remember or are
        rigid take the reference method with ``time_step``. If estimates are asked for,
        what is stored of equal steps is rounded up to whole double steps.
    start
        Initial displacement and velocity; all at rest and without load if left out.
        From the checkpoint of a block of the same march, the rest of it is yielded.
    block
        Length of a block [s]; :data:`BLOCK`, or :data:`ROWS` if those are less.

    Raises
    ------
    ValueError
        If the block has no length or the structure is sparse.
    IntegrationError
        If a step does not converge even when it is divided; what was yielded stays.
    """
    if block is None:
        block = min(BLOCK, ROWS * options.time_step * options.store_every)
    if not 0.0 < block < math.inf:
        raise ValueError(f"block of {block:g} s: give a positive finite length")
    if beyond_motion(problem.interface.points):
        options = replace(options, method="reference", tolerance=None)
    steps = whole_steps(history.duration, options.time_step)
    stride = min(options.store_every, steps)
    options = replace(options, store_every=stride)
    group = rows_between(options) if options.estimate else 1
    rows = group * -(-steps // (stride * group))
    begin = (
        at_rest(problem) if start is None or isinstance(start, Checkpoint) else start
    )
    method = FastMarch if options.method == "fast" else ReferenceMarch
    told = problem, history, options, rows * stride, begin
    marching = StepDoubling(method, *told) if options.estimate else method(*told)
    done = marching.resume(start) // stride if isinstance(start, Checkpoint) else 0
    per_block = group * max(1, round(block * rows / (history.duration * group)))
    for first in range(done, rows, per_block):
        count = min(per_block, rows - first)
        yield marching.block(first * stride, count * stride)


def whole_steps(duration: float, longest: float) -> int:
    """Return how many equal steps, none longer than ``longest``, fill a duration."""
    return max(1, math.ceil(duration / longest * (1.0 - ROUNDING) - 1e-9))
