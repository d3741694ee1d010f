"""What the fast march is told: steps, their ladder, and tolerances (theory, §7.2)."""

from __future__ import annotations

import math

import numpy as np

from microslip_mechanics.loads.segments import Segments, clock
from timedomain.contact.state import State
from timedomain.fast.coordinates import Coordinates
from timedomain.fast.energy_scale import least_energy, settled
from timedomain.fast.ladder import TICKS
from timedomain.fast.motion import Control
from timedomain.fast.tables import LEVELS
from timedomain.options import MarchOptions

PER_CYCLE, CYCLED = 12, 3e-4
"""least number of steps in a cycle of the load, and the error that they make; it falls
with their fourth power"""
RESIDUAL = 1e-2
"""of contact forces, over the tolerance of one step"""
HOLD = 0.5
"""cycles of the load without a rough step before steps grow"""
ROUNDING = 1e-9
"""of a number of steps, relative"""
SAFETY = 0.05
"""error of one step over the tolerance of the whole march"""


def fast_control(
    options: MarchOptions,
    segments: Segments,
    *,
    coordinates: Coordinates,
    state: State,
    duration: float,
    step: float,
    force_scale: float,
) -> Control:
    """Return step, ladder and tolerances.

    Parameters
    ----------
    options, segments
        What is asked for, and the loads.
    coordinates, state
        Of the structure, and where it begins.
    duration, step
        Of the whole march, and nominal [s].
    force_scale
        What forces are compared with [N].
    """
    cycle = _cycle(segments, duration)
    longest, stride, tolerance = step, options.store_every, 0.0
    lowest = min(LEVELS - 1, options.divisions)
    if options.tolerance is not None:
        longest, stride = _divided(step * stride, cycle, options.tolerance)
        tolerance, lowest = SAFETY * options.tolerance, LEVELS - 1
    floor = 1e-10 * force_scale
    residual = options.residual
    if tolerance > 0.0:
        residual = max(residual, RESIDUAL * tolerance)
    hold = int(TICKS * HOLD * cycle / longest) if tolerance > 0.0 else 0
    modes, inverse = coordinates.modes, coordinates.inverse
    least = least_energy(modes, inverse, state, segments, longest)
    still = min(settled(segments), duration)
    tick = math.ceil(TICKS * (still / longest) * (1.0 - ROUNDING))
    return Control(
        longest, stride, tolerance, residual, floor, lowest, hold, least, tick
    )


def _divided(row: float, cycle: float, tolerance: float) -> tuple[float, int]:
    """Return the longest step [s] that keeps a tolerance, and how many make a row."""
    steps = PER_CYCLE * max(1.0, CYCLED / tolerance) ** 0.25
    wanted = min(cycle / steps, row)
    stride = 2 ** max(0, math.ceil(math.log2(row / wanted) - 1e-9))
    return row / stride, stride


def _cycle(segments: Segments, duration: float) -> float:
    """Return the shortest cycle of the load [s], or the whole march."""
    begin = segments.begin
    edges = np.append(begin, duration)
    times = np.concatenate([edges, begin + 1e-9 * np.diff(edges)])
    fastest = float(np.abs(clock(segments, times)[:, 0]).max())
    return min(2.0 * np.pi / fastest, duration) if fastest else duration
