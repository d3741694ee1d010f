"""A first point by a drive that grows, as finely resolved as each one asks for (§6.2).

Higher harmonics may meet resonances of their own that coarse responses know nothing of:
no iteration leads from those to finer ones, while small steps of the drive do.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from hbm.continuation.continuation import trace
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.paths.along_share import LEAST, AlongShare, whole
from hbm.paths.path import Path
from hbm.paths.path_metric import path_metric
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

PATIENCE = 1500
"""evaluations after which it is given up"""
Resolved: TypeAlias = Callable[[Path, Effort], AdaptiveBalance]
"""path, effort granted ↦ the system that follows it"""


def grown(
    path: Path,
    parameter: float,
    resolved: Resolved,
    control: StepControl,
    effort: Effort,
) -> Array:
    """Return the coefficients of a response under the whole drive, (2H + 1, rank).

    Raises
    ------
    ContinuationError
        If the drive does not come to be whole, or not with the effort granted.
    """
    drives, part = AlongShare(path, parameter), effort.part(PATIENCE)
    system = resolved(drives, part)
    still, _ = drives.at(LEAST)
    start = np.zeros(system.size)
    start[: still.rank], start[-1] = still.rest, LEAST
    corrections = trace(
        system,
        start,
        1.0,
        metric=partial(path_metric, drives),
        control=replace(control, most_points=PATIENCE),
        settler=system,
        begin=-1.0,
    )
    try:
        point = whole(corrections, parameter)
    finally:
        effort.spent += part.spent
    count = system.settled.coefficients
    return point[: count * still.rank].reshape(count, still.rank)
