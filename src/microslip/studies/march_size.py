"""What a march would take: those that would not end are refused before they begin."""

from __future__ import annotations

import math

import numpy as np

from microslip.scenes.quantity import SceneError
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.loads.segments import clock
from microslip_mechanics.problem import Problem
from timedomain.options import MarchOptions

MOST_STEPS = 1e10
"""of a march: hours for one mass, days for a rig"""
MOST_ROWS = 2.0**31 - 1.0
"""of a result file, which counts them in so many bits"""
MOST_HELD = 1e7
"""rows of a block, which memory holds until it is written: 1 GB or more"""


def demand_end(
    loads: LoadHistory,
    options: MarchOptions,
    remedy: str,
    *,
    block: float = 0.0,
    stored: bool = True,
) -> None:
    """Refuse a march of too many steps, or of too many rows.

    Parameters
    ----------
    loads, options
        Of the march. Where a tolerance sets its steps, they are at least one for each
        row and one for each turn of the drive.
    remedy
        What may be given instead.
    block
        Length [s] of what is held in memory; none if it is short.
    stored
        Whether the rows are, or those of their envelope alone.

    Raises
    ------
    SceneError
        With what the march would take, and the remedy.
    """
    steps, turned = _ratio(loads.duration, options.time_step), turns(loads)
    rows = steps / options.store_every
    held = _ratio(block, options.time_step) / options.store_every
    least = max(steps if options.tolerance is None else rows, turned)
    for wanted, most, what in (
        (least, MOST_STEPS, "steps"),
        (rows if stored else turned, MOST_ROWS, "stored rows"),
        (held, MOST_HELD, "rows in memory"),
    ):
        if not wanted <= most:
            raise SceneError(
                f"a march of {loads.duration:.3g} s with a time step of "
                f"{options.time_step:.3g} s and {turned:.2g} cycles takes "
                f"{wanted:.2g} {what}, and may take {most:.2g}: {remedy}"
            )


def turns(loads: LoadHistory) -> float:
    """Return how often the drive turns; inf if beyond numbers."""
    with np.errstate(over="ignore", invalid="ignore"):
        phase = clock(loads.segments(), np.array([0.0, loads.duration]))[:, 2]
        turned = float(phase[1] - phase[0]) / math.tau
    return turned if math.isfinite(turned) else math.inf


def _ratio(length: float, step: float) -> float:
    """Return how many steps fill a length; inf if beyond numbers."""
    return length / step if length < 1e300 * step else math.inf


def demand_dense(problem: Problem) -> None:
    """Say what a march would say of a sparse structure, before a curve is traced.

    Raises
    ------
    ValueError
        If it is one.
    """
    _ = problem.structure.dense
