"""Extrapolation along a curve, of the order that has served best (theory §6.2)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import islice

import numpy as np

from hbm.continuation.arc import distance
from microslip_mechanics.arrays import Array

MOST = 3
"""earlier points that are looked back upon"""
STEEPEST = 0.2
"""most that an extrapolation may leave the tangent, over the step"""


class Predictor:
    """Polynomial through the last points and the tangent at the last of them."""

    def __init__(self) -> None:
        """Begin without a past."""
        self._points: list[Array] = []
        self._places: list[float] = []
        self._bends: list[Array] = []
        self.tangent: Array = np.empty(0)
        """at the last point"""
        self.scale: Array = np.empty(0)
        """in units of arc there"""
        self.order = 1
        """of the extrapolation that predicted the last point best"""
        self.orientation = 0.0
        """of the last point, as a correction has it"""

    @property
    def point(self) -> Array:
        """The last point."""
        return self._points[0]

    def begin(self, point: Array, tangent: Array, orientation: float) -> None:
        """Begin anew with the last point as it is now, and its unit tangent there."""
        self._points, self._places, self._bends = [point], [0.0], []
        self.tangent, self.order, self.orientation = tangent, 1, orientation

    def append(self, point: Array, tangent: Array, scale: Array, step: float) -> float:
        """Add a point that lies ``step`` further on, and its unit tangent.

        Returns
        -------
        How far the best extrapolation missed the point, in units of ``scale``.
        """
        missed = [distance(each, point, scale) for each in self._extrapolated(step)]
        if missed:
            self.order = 1 + int(np.argmin(missed))
        self._points = [point, *self._points][: MOST + 1]
        self._places = [0.0, *(place - step for place in self._places)][: MOST + 1]
        self.tangent, self.scale = tangent, scale
        self._bends = self._differences()
        return min(missed, default=0.0)

    def _differences(self) -> list[Array]:
        """Return the divided differences of (x(s) − x(0) − s x'(0))/s²."""
        start, places = self._points[0], self._places[1:]
        bends: list[Array] = [
            (point - start - place * self.tangent) / place**2
            for point, place in zip(self._points[1:], places, strict=True)
        ]
        for width in range(1, len(bends)):
            for i in range(len(bends) - 1, width - 1, -1):
                apart = places[i] - places[i - width]
                bends[i] = (bends[i] - bends[i - 1]) / apart
        return bends

    def predict(self, step: float) -> Array:
        """Return the point expected ``step`` further on.

        An extrapolation that leaves the tangent by much is not trusted: rounding and
        the corrector's tolerance grow with its order.
        """
        line, *others = islice(self._extrapolated(step), self.order)
        for expected in reversed(others):
            if distance(expected, line, self.scale) <= STEEPEST * step:
                return expected
        return line

    def _extrapolated(self, step: float) -> Iterator[Array]:
        """Yield x(step) of the polynomials of order 1, 2, … with x(0), x'(0) as known.

        Order 1 is the tangent; each further order takes one more earlier point.
        """
        if not self._points:
            return
        reached = self._points[0] + step * self.tangent
        yield reached
        weight = step**2
        for bend, place in zip(self._bends, self._places[1:], strict=True):
            reached = reached + weight * bend
            yield reached
            weight *= step - place
