"""Where Floquet multipliers cross the unit circle between two points (theory §6.4)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from hbm.continuation.correction import Correction
from hbm.continuation.segment import PRECISION, ROUGH, ROUGHER, Segment, folds
from hbm.events.crossed import BRANCH, crossed, crossings, turns
from hbm.events.crossing_error import crossing_error, witness
from hbm.events.moving_multiplier import MovingMultiplier
from hbm.events.multipliers import HARMONICS, Multipliers
from hbm.events.settled import Settled
from hbm.forces.fourier import FourierBasis, by_harmonics
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

LOCATING = FourierBasis(31, 256)
"""most that is taken at first, if the curve has no more, to locate a change of
stability"""
ASTRAY = 0.01
"""distance of a multiplier from +1 at which an orbit as it is reported is no branch
point: the crossing is located again with all harmonics, then more precisely"""
NEAR = 0.01
"""of a step, from its ends"""
LEAP = 0.1
"""of the change of a multiplier between two points: what is left of its excess where it
is located, from which on it leaps"""


class Crossing(NamedTuple):
    """A multiplier on the unit circle."""

    name: str
    """of what happens there"""
    point: Correction
    error: Callable[[], float]
    """of the parameter; NaN if nothing is known of it"""


@dataclass(frozen=True, slots=True)
class Crossings:
    """Finds them along a path."""

    system: AdaptiveBalance
    multipliers: Multipliers
    recalls: bool
    """whether a contact has a memory"""

    def between(
        self, segment: Segment, before: Settled, after: Settled
    ) -> Iterator[Crossing]:
        """Yield what happens where a multiplier crosses the circle."""
        paired = False
        if before.multipliers.size != after.multipliers.size:
            return  # one of the two has none that are known
        for which in crossings(before.multipliers, after.multipliers):
            if paired:  # a conjugate crosses where the one before it does
                paired = False
                continue
            crossing, multiplier = self._crossing(segment, which, before, after)
            paired = turns(multiplier)
            if crossing is not None:
                yield crossing

    def _crossing(
        self, segment: Segment, which: int, before: Settled, after: Settled
    ) -> tuple[Crossing | None, complex]:
        """Return where a multiplier crosses the unit circle, if it does, and its value.

        The value is the one next to it that is still outside. A multiplier that leaps
        over the circle does not cross it: a slider begins to slip there, or sticks for
        good, and nothing branches.
        """
        told, finer, precision = self._asked(before, after)
        moving = MovingMultiplier(which, before.multipliers, after.multipliers)
        located = None
        if finer is not None:
            located = self._among(segment, moving, finer, before, after, precision)
        if located is None:
            located = self._along(segment, moving, finer, precision)
        if told != finer and self._ends(segment, located, told):
            moving = MovingMultiplier(which, before.multipliers, after.multipliers)
            again = self._along(segment, moving, told, precision)
            located, finer = (again, told) if again else (located, finer)
        for each in (precision, PRECISION):
            if not self._astray(segment, located, moving, told):
                break
            moving = MovingMultiplier(which, before.multipliers, after.multipliers)
            located, finer = self._along(segment, moving, told, each), told
            precision = each
        multiplier = moving.outside
        if located is None:
            return None, multiplier
        used = finer or self.system.fourier
        other = witness(used, told or used)
        made = self._made(segment, located, moving, finer, other, precision)
        return made, multiplier

    def _made(
        self,
        segment: Segment,
        located: Correction,
        moving: MovingMultiplier,
        finer: FourierBasis | None,
        other: FourierBasis,
        precision: float,
    ) -> Crossing | None:
        """Return a crossing that was located; None if the multiplier leaps there.

        Its error is that by orbits of the ``other`` resolution.
        """
        name, (first, last) = _name(moving), moving.ends
        if self.recalls:
            left = abs(self._growth(moving, located, finer))
            if left > LEAP * abs(last - first):
                return None

        def error() -> float:
            orbit = self._orbit(located, other)
            if orbit is None:
                return math.nan
            doubt = moving.growth(self.multipliers.at(*orbit))
            doubt -= self._growth(moving, located, finer)
            return crossing_error(segment, located, moving.ends, abs(doubt), precision)

        return Crossing(name, located, error)

    def _along(
        self,
        segment: Segment,
        moving: MovingMultiplier,
        finer: FourierBasis | None,
        precision: float,
    ) -> Correction | None:
        """Return where a multiplier crosses of the orbits at the frequencies of a step.

        They have the finer resolution, if there is one.
        """
        return segment.locate(
            lambda each: self._growth(moving, each, finer), moving.ends, precision
        )

    def _ends(
        self,
        segment: Segment,
        located: Correction | None,
        told: FourierBasis | None,
    ) -> bool:
        """Return whether what was located lies about at an end of its step.

        Orbits with fewer harmonics than those at the ends may cross beyond it. Where
        there are none with so many nothing is asked for again.
        """
        if located is None:
            return False
        place = segment.place(located.point) / segment.length
        if NEAR < place < 1.0 - NEAR:
            return False
        return self._orbit(located, told) is not None

    def _astray(
        self,
        segment: Segment,
        located: Correction | None,
        moving: MovingMultiplier,
        told: FourierBasis | None,
    ) -> bool:
        """Return whether no branch point is confirmed by the orbit as it is reported.

        Where the curve folds a multiplier crosses in any case, and where there is no
        such orbit none confirms it elsewhere: nothing is asked for again.
        """
        if _name(moving) != BRANCH:
            return False
        folded = segment.after.turns or folds(segment.before) * folds(segment.after) < 0
        if located is None or folded or self.recalls:
            return False
        orbit = self._orbit(located, told)
        if orbit is None:
            return False
        return bool(abs(moving.growth(self.multipliers.at(*orbit))) > ASTRAY)

    def _among(
        self,
        segment: Segment,
        moving: MovingMultiplier,
        finer: FourierBasis,
        before: Settled,
        after: Settled,
        precision: float,
    ) -> Correction | None:
        """Return where a multiplier of orbits with a finer resolution crosses.

        They are found between those that are reported; None if one is not, or if points
        have no room for so many.
        """
        if finer.coefficients * self.multipliers.resolution.rank >= self.system.size:
            return None
        system = self.multipliers.resolution.at(finer)
        ends = before.reported, after.reported
        orbits = replace(
            segment, system=system, before=ends[0], after=ends[1], tangents=False
        )
        located = orbits.locate(
            lambda each: moving.growth(self.multipliers.at(each.point, finer)),
            moving.ends,
            precision,
        )
        if located is None:
            return None
        guess = located.point.copy()
        guess[
            self.system.fourier.coefficients * self.multipliers.resolution.rank : -1
        ] = 0.0
        return segment.across(guess, precision * segment.length)

    def _asked(
        self, before: Settled, after: Settled
    ) -> tuple[FourierBasis | None, FourierBasis | None, float]:
        """Return the resolution of multipliers at two points, what may do, a precision.

        It is that of the orbits that are reported, or what their multipliers ask for;
        none if it is that of the curve. Where so many were asked for, fewer do not do.
        """
        own, asks = self.system.fourier, before.asks or after.asks
        told = max(before.finer, after.finer, key=by_harmonics)
        samples = max(LOCATING.samples, own.samples)
        most = replace(LOCATING, samples=samples, threshold=told.threshold)
        finer = min(told, max(own, most, key=by_harmonics), key=by_harmonics)
        if asks and told.harmonics > HARMONICS:
            finer = told
        precision = ROUGHER if asks else ROUGH
        first, second = (
            each if each.harmonics > own.harmonics else None for each in (told, finer)
        )
        return first, second, precision

    def _growth(
        self,
        moving: MovingMultiplier,
        correction: Correction,
        finer: FourierBasis | None,
    ) -> float:
        """Return that of a multiplier of the orbit with a finer resolution at a point.

        Or of the point's own, if there is none.
        """
        orbit = self._orbit(correction, finer)
        point, fourier = orbit or (correction.point, self.system.fourier)
        return moving.growth(self.multipliers.at(point, fourier))

    def _orbit(
        self, correction: Correction, finer: FourierBasis | None
    ) -> tuple[Array, FourierBasis] | None:
        """Return the orbit with a finer resolution at a point, and which; if found.

        The point itself, if no other is asked for.
        """
        if finer is None:
            return correction.point, self.system.fourier
        found = self.multipliers.orbits.finer(correction.point, finer)
        return None if found is None else (found, finer)


def _name(moving: MovingMultiplier) -> str:
    """Return what happens where a multiplier crosses."""
    return crossed(moving.outside, alone=moving.alone)
