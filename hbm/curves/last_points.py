"""The last points of a curve, some of which it may take back (theory §6.2)."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from hbm.continuation.cornered import REMEMBERED
from microslip_mechanics.results.response import PeriodicResponse

ROUNDED = 1e-12
"""of the larger limit, by which a parameter may be beyond it"""


class LastPoints:
    """What was told of the last points of a curve, within its limits."""

    def __init__(self, limits: tuple[float, float]) -> None:
        """Begin without points; of the parameter between two ``limits``."""
        slack = ROUNDED * max(map(abs, limits))
        self._least, self._most = limits[0] - slack, limits[1] + slack
        self._told: deque[list[PeriodicResponse]] = deque(maxlen=REMEMBERED)

    def added(self, made: Sequence[PeriodicResponse]) -> list[PeriodicResponse]:
        """Return what is told of the next point: more harmonics may be beyond."""
        told = [each for each in made if self._least <= each.parameter <= self._most]
        self._told.append(told)
        return told

    def taken_back(self, points: int) -> list[PeriodicResponse]:
        """Return what was told of so many of the last points, and forget it."""
        return [each for _ in range(points) for each in self._told.pop()]
