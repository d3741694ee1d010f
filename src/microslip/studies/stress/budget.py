"""The time of a whole stress matrix, and what of it each case may take."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass, field

from microslip.studies.stress.case import Case

WHOLE = 550.0
"""seconds for all cases: a matrix takes ten minutes, its beginning and end included"""
MOST, LEAST = 40.0, 5.0
"""seconds of the processor that a case may take, and may always take"""
GENEROUS = 2.0
"""times an equal share of what is left: most cases do not take theirs"""


@dataclass(frozen=True, slots=True)
class Budget:
    """What is left of the time, shared out as the cases begin."""

    processes: int
    """that work at the same time"""
    whole: float = WHOLE
    """seconds for all"""
    most: float = MOST
    """seconds of the processor for a case"""
    began: float = field(default_factory=time.monotonic)

    @classmethod
    def each(cls, seconds: float, processes: int) -> Budget:
        """Return one that lets each case take as long, however long that takes."""
        return cls(processes, math.inf, seconds)

    def share(self, waiting: Sequence[Case]) -> float:
        """Return seconds of the processor for the first of the cases still to begin.

        Values that are none take no time.
        """
        left = sum(not case.refusals for case in waiting)
        wall = self.began + self.whole - time.monotonic()
        fair = self.processes * wall / max(left, 1)
        return min(self.most, max(GENEROUS * fair, LEAST))
