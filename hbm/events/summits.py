"""The largest amplitudes along a curve, by its points as they are reported (§6.4).

Growth along a curve tells peaks sharply, but also where the amplitude only ripples, by
less than its error, from one resolution to the next; and it may miss one for that.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import PeriodicResponse

EQUAL = 1e-9
"""difference of amplitudes, relative, that may be rounding"""


class Summits:
    """Compares peaks with the points about them."""

    def __init__(self, probes: Array) -> None:
        """Look at ``probes``, shape (probes, dofs)."""
        self._probes = probes
        self._last: PeriodicResponse | None = None
        self._before: list[PeriodicResponse] = []
        """the point before the last one, and the events between them"""

    def begin(self, made: PeriodicResponse) -> None:
        """Begin anew with a point that does not hang together with the last one."""
        self._last, self._before = made, []

    def among(
        self, found: list[PeriodicResponse], made: PeriodicResponse
    ) -> Iterator[PeriodicResponse]:
        """Yield what was ``found`` before the next point, ``made``, but for no peaks.

        A peak is no lower than either point beside it. Where the last point is above
        all beside it, and none of these is a peak, it is one itself, somewhere between
        the points beside it, and as much higher as the parabola through all three.
        """
        last, before = self._last, self._before
        if last is None:
            return
        beside = max(self._size(last), self._size(made))
        found = [
            each
            for each in found
            if each.event != "peak" or self._size(each) >= (1.0 - EQUAL) * beside
        ]
        if before and self._stands_out(last, [*before, *found, made]):
            yield self._summit(before[0], last, made)
        yield from found
        self._last, self._before = made, [last, *found]

    def _stands_out(
        self, last: PeriodicResponse, beside: list[PeriodicResponse]
    ) -> bool:
        """Return whether a point is above all beside it, and none of these a peak."""
        if any(each.event == "peak" for each in beside):
            return False
        nearest = max(self._size(each) for each in beside)
        return self._size(last) > (1.0 + EQUAL) * nearest

    def _summit(
        self, before: PeriodicResponse, last: PeriodicResponse, after: PeriodicResponse
    ) -> PeriodicResponse:
        """Return a point as a peak, with what it may be aside and lower than that."""
        size = self._size(last)
        ways = [abs(each.parameter - last.parameter) for each in (before, after)]
        falls = [size - self._size(each) for each in (before, after)]
        error = last.error + _lacking(*ways, *falls) / size
        return replace(last, event="peak", error=error, parameter_error=max(ways))

    def _size(self, made: PeriodicResponse) -> float:
        """Return the largest first harmonic of a probe [m]."""
        return made.largest(self._probes)


def _lacking(back: float, on: float, before: float, after: float) -> float:
    """Return what a point is below the top of the parabola through those beside it.

    These are as far away as ``back`` and ``on``, and lower by ``before`` and ``after``,
    by more than which the top is not told to be higher.
    """
    most = max(before, after)
    if back * on == 0.0:
        return most
    slope = before * on / back - after * back / on
    bend = 4.0 * (back + on) * (before / back + after / on)
    return min(slope**2 / bend, most)
