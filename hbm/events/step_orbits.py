"""Orbits within a step of a curve, and where a multiplier of them crosses."""

from __future__ import annotations

from dataclasses import dataclass, replace

from hbm.continuation.correction import Correction
from hbm.continuation.segment import Segment, folds
from hbm.events.moving_multiplier import MovingMultiplier
from hbm.events.multipliers import Multipliers
from hbm.events.settled import Settled
from hbm.forces.fourier import FourierBasis
from hbm.resolution.adaptive import AdaptiveBalance
from microslip_mechanics.arrays import Array

NEAR = 0.01
"""of a step, from its ends"""


@dataclass(frozen=True, slots=True)
class StepOrbits:
    """Those with the resolution of a curve, or with finer ones."""

    system: AdaptiveBalance
    multipliers: Multipliers
    segment: Segment
    """the step"""

    def at(
        self, correction: Correction, finer: FourierBasis | None
    ) -> tuple[Array, FourierBasis] | None:
        """Return the orbit with a finer resolution at a point, and which; if found.

        The point itself, if no other is asked for.
        """
        if finer is None:
            return correction.point, self.system.fourier
        found = self.multipliers.orbits.finer(correction.point, finer)
        return None if found is None else (found, finer)

    def growth(
        self,
        moving: MovingMultiplier,
        correction: Correction,
        finer: FourierBasis | None,
    ) -> float:
        """Return that of a multiplier of the orbit with a finer resolution at a point.

        Or of the point's own, if there is none.
        """
        orbit = self.at(correction, finer)
        point, fourier = orbit or (correction.point, self.system.fourier)
        return moving.growth(self.multipliers.at(point, fourier))

    def along(
        self, moving: MovingMultiplier, finer: FourierBasis | None, precision: float
    ) -> Correction | None:
        """Return where a multiplier crosses of the orbits at the frequencies of a step.

        They have the finer resolution, if there is one.
        """
        return self.segment.locate(
            lambda each: self.growth(moving, each, finer), moving.ends, precision
        )

    def among(
        self,
        moving: MovingMultiplier,
        finer: FourierBasis,
        ends: tuple[Settled, Settled],
        precision: float,
    ) -> Correction | None:
        """Return where a multiplier of orbits with a finer resolution crosses.

        They are found between those that are reported at the ends of the step; None if
        one is not, or if points have no room for so many.
        """
        rank = self.multipliers.resolution.rank
        if finer.coefficients * rank >= self.system.size:
            return None
        orbits = replace(
            self.segment,
            system=self.multipliers.resolution.at(finer),
            before=ends[0].reported,
            after=ends[1].reported,
            tangents=False,
        )
        located = orbits.locate(
            lambda each: moving.growth(self.multipliers.at(each.point, finer)),
            moving.ends,
            precision,
        )
        if located is None:
            return None
        guess = located.point.copy()
        guess[self.system.fourier.coefficients * rank : -1] = 0.0
        return self.segment.across(guess, precision * self.segment.length)

    def ends(self, located: Correction) -> bool:
        """Return whether what was located lies about at an end of the step."""
        place = self.segment.place(located.point) / self.segment.length
        return not NEAR < place < 1.0 - NEAR

    @property
    def folded(self) -> bool:
        """Whether the curve goes back within the step: a multiplier crosses there."""
        before, after = self.segment.before, self.segment.after
        return after.turns or folds(before) * folds(after) < 0
