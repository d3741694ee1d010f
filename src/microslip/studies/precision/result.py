"""What a method finds at one setting, and how a march comes to it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from microslip.studies.precision.case import Case
from microslip.studies.precision.march import PERIODS, Carried
from microslip.studies.precision.orbit import Orbit
from timedomain.record.start import Start
from timedomain.shooting.steady import steady


@dataclass(frozen=True, slots=True)
class Result:
    """What a method finds at one setting."""

    orbit: Orbit
    seconds: float
    """of one thread's processor; of a march those of one period"""
    marches: bool
    """whether that is of one period, of many that pass before the motion is steady"""
    left: float = 0.0
    """estimated distance from the method's own steady state, over the vibration"""


def steady_result(case: Case, carried: Callable[[Start], Carried]) -> Result:
    """Return what a march finds in its steady state."""
    fastest = math.inf

    def timed(start: Start) -> Carried:
        nonlocal fastest
        made = carried(start)
        fastest = min(fastest, made.seconds)
        return made

    found = steady(case.slope, timed, case.start, PERIODS)
    return Result(found.made.orbit, fastest, marches=True, left=found.left)
