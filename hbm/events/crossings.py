"""Where Floquet multipliers cross the unit circle between two points (theory §6.4)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import NamedTuple

from hbm.continuation.correction import Correction
from hbm.continuation.segment import PRECISION, ROUGH, ROUGHER, Segment
from hbm.events.crossed import BRANCH, crossed, crossings, turns
from hbm.events.crossing_error import crossing_error, witness
from hbm.events.moving_multiplier import MovingMultiplier
from hbm.events.multipliers import HARMONICS, Multipliers
from hbm.events.settled import Settled
from hbm.events.step_orbits import StepOrbits
from hbm.forces.fourier import FourierBasis, by_harmonics
from hbm.resolution.adaptive import AdaptiveBalance

LOCATING = FourierBasis(31, 256)
"""most that is taken at first, if the curve has no more, to locate a change of
stability"""
ASTRAY = 0.01
"""distance of a multiplier from +1 at which an orbit as it is reported is no branch
point: the crossing is located again with all harmonics, then more precisely"""
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
        orbits = StepOrbits(self.system, self.multipliers, segment)
        for which in crossings(before.multipliers, after.multipliers):
            if paired:  # a conjugate crosses where the one before it does
                paired = False
                continue
            crossing, multiplier = self._crossing(orbits, which, before, after)
            paired = turns(multiplier)
            if crossing is not None:
                yield crossing

    def _crossing(
        self, orbits: StepOrbits, which: int, before: Settled, after: Settled
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
            located = orbits.among(moving, finer, (before, after), precision)
        if located is None:
            located = orbits.along(moving, finer, precision)
        if told != finer and _beyond(orbits, located, told):
            moving = MovingMultiplier(which, before.multipliers, after.multipliers)
            again = orbits.along(moving, told, precision)
            located, finer = (again, told) if again else (located, finer)
        for each in (precision, PRECISION):
            if not self._astray(orbits, located, moving, told):
                break
            moving = MovingMultiplier(which, before.multipliers, after.multipliers)
            located, finer = orbits.along(moving, told, each), told
            precision = each
        multiplier = moving.outside
        if located is None:
            return None, multiplier
        used = finer or self.system.fourier
        other = witness(used, told or used)
        made = self._made(orbits, located, moving, finer, other, precision)
        return made, multiplier

    def _made(
        self,
        orbits: StepOrbits,
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
            left = abs(orbits.growth(moving, located, finer))
            if left > LEAP * abs(last - first):
                return None

        def error() -> float:
            orbit = orbits.at(located, other)
            if orbit is None:
                return math.nan
            doubt = moving.growth(self.multipliers.at(*orbit))
            doubt = abs(doubt - orbits.growth(moving, located, finer))
            return crossing_error(
                orbits.segment, located, moving.ends, doubt, precision
            )

        return Crossing(name, located, error)

    def _astray(
        self,
        orbits: StepOrbits,
        located: Correction | None,
        moving: MovingMultiplier,
        told: FourierBasis | None,
    ) -> bool:
        """Return whether no branch point is confirmed by the orbit as it is reported.

        Where the curve folds a multiplier crosses in any case, and where there is no
        such orbit none confirms it elsewhere: nothing is asked for again.
        """
        if located is None or self.recalls or orbits.folded or _name(moving) != BRANCH:
            return False
        orbit = orbits.at(located, told)
        if orbit is None:
            return False
        return bool(abs(moving.growth(self.multipliers.at(*orbit))) > ASTRAY)

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


def _beyond(
    orbits: StepOrbits, located: Correction | None, told: FourierBasis | None
) -> bool:
    """Return whether orbits as they are reported may cross beyond what was located.

    Fewer harmonics than at the ends of a step may end where it does. Where there are no
    orbits with so many nothing is asked for again.
    """
    if located is None or not orbits.ends(located):
        return False
    return orbits.at(located, told) is not None


def _name(moving: MovingMultiplier) -> str:
    """Return what happens where a multiplier crosses."""
    return crossed(moving.outside, alone=moving.alone)
