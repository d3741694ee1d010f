"""A first point by a share that grows, as finely resolved as each one asks for (§6.2).

Higher harmonics may meet resonances of their own that coarse responses know nothing of:
no iteration leads from those to finer ones, while small steps of the drive do, or of
the stiffness of stops.
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
from hbm.paths.along_share import AlongShare, whole
from hbm.paths.path import Path
from hbm.paths.path_metric import path_metric
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

POINTS = 1500
"""after which it is given up"""
Resolved: TypeAlias = Callable[[Path, Effort], AdaptiveBalance]
"""path, effort granted ↦ the system that follows it"""


def grown(
    shares: AlongShare,
    first: float,
    resolved: Resolved,
    patience: float,
    control: StepControl,
    effort: Effort,
) -> Array:
    """Return the coefficients of a response of the whole problem, (2H + 1, rank).

    The share changes from ``first`` on. After ``patience`` it is given up; ``effort``
    counts what it takes.

    Raises
    ------
    ContinuationError
        If it does not arrive.
    """
    part = effort.part(patience)
    system = resolved(shares, part)
    start, begins = np.zeros(system.size), shares.begins(first).ravel()
    start[: begins.size], start[-1] = begins, first
    corrections = trace(
        system,
        start,
        1.0,
        metric=partial(path_metric, shares),
        control=replace(control, most_points=POINTS),
        settler=system,
        begin=shares.least,
    )
    try:
        point = whole(corrections, shares.place)
    finally:
        effort.spent += part.spent
    count = system.settled.coefficients
    return point[: count * shares.rank].reshape(count, shares.rank)
