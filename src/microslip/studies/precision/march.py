"""What a march makes of a motion in a few periods, and how long it takes."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass

import numpy as np

from microslip.studies.precision.orbit import PHASES, Orbit
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.checkpoint import at_end
from timedomain.record.start import Start

PERIODS = 2
"""that are marched at a time: of the second, what began anew is forgotten"""


@dataclass(frozen=True, slots=True)
class Carried:
    """What a method makes of a motion in :data:`PERIODS` periods."""

    end: Start
    orbit: Orbit
    """the last of the periods"""
    seconds: float
    """of one thread's processor, per period"""


def march(
    problem: Problem,
    frequency: float,
    options: MarchOptions,
    periods: int,
    start: Start,
) -> Carried:
    """March some periods from a motion; the last one is measured."""
    duration = periods * math.tau / frequency
    began = time.process_time()
    (history,) = integrate(
        problem, Dwell(frequency, duration), options, start=start, block=duration
    )
    seconds = (time.process_time() - began) / periods
    flows = [history.of(f"{name}_damping") for name in ("normal", "structural")]
    taken = np.stack([history.of("friction"), *flows], axis=1)
    # rows end their steps: phase 0 of the last period is the row before its first
    taken = np.vstack([np.zeros(3), taken])
    out = taken[-1] - taken[-1 - PHASES]
    first = problem.probes.rows @ start.displacement
    shown = np.vstack([first, history.displacement])[-1 - PHASES : -1]
    assert history.checkpoint is not None
    orbit = Orbit(shown, float(out[0]), float(out.sum()))
    return Carried(at_end(problem, history.checkpoint), orbit, seconds)


def fixed_step(frequency: float, steps: int, method: str) -> MarchOptions:
    """Return options of equal steps, a multiple of :data:`PHASES` in each period."""
    stride = max(1, steps // PHASES)
    step = math.tau / frequency / (stride * PHASES)
    if method == "reference":
        return MarchOptions(step, stride, method="reference", residual=1e-12)
    return MarchOptions(step, stride)
