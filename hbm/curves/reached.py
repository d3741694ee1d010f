"""A response with some residual tractions, and what others would change (§6.5)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import upright
from hbm.continuation.correction import Outcome
from hbm.continuation.newton import correct
from hbm.curves.leeway import Leeway
from microslip_mechanics.arrays import Array
from microslip_mechanics.results.response import measure

GAIN = 1e-3
"""change of an amplitude that counts, over its measure"""
PARTS = (1.0, 0.5, 0.25, 0.1)
"""of a change of tractions that are tried"""
ITERATIONS = 15
"""of Newton, for a response"""


@dataclass(frozen=True)
class Reached:
    """A response with some residual tractions."""

    balance: HarmonicBalance
    point: Array
    rows: Array
    """probes of the motion, shape (probes, dofs)"""
    tolerance: float
    """of the largest residual [N]"""

    @classmethod
    def by(
        cls,
        balance: HarmonicBalance,
        bent: Array | None,
        guess: Array,
        rows: Array,
        tolerance: float,
    ) -> Reached | None:
        """Return the response with sliders that are bent so, if it is found."""
        made = balance.with_problem(replace(balance.problem, bent=bent))
        found = correct(
            made,
            guess,
            upright(guess),
            tolerance=tolerance,
            max_iterations=ITERATIONS,
        )
        if found.outcome is not Outcome.CONVERGED:
            return None
        return cls(made, found.point, rows, tolerance)

    @cached_property
    def amplitude(self) -> Array:
        """Of the probes [m], shape (probes,)."""
        found: Array = np.hypot(*(self.balance.motion(self.point)[1:3] @ self.rows.T))
        return found

    @cached_property
    def measure(self) -> Array:
        """What their changes are shares of [m], shape (probes,)."""
        return measure(self.amplitude)

    @cached_property
    def leeway(self) -> Leeway:
        """What other tractions change, to first order."""
        return Leeway.of(self.balance, self.point, self.rows)

    def beyond(self, other: Reached, probe: int, sign: float) -> bool:
        """Return whether the amplitude of a probe is farther than another one."""
        gained = sign * (self.amplitude[probe] - other.amplitude[probe])
        return bool(gained > GAIN * other.measure[probe] > 0.0)

    def bent_by(self, bent: Array | None, guess: Array | None = None) -> Reached | None:
        """Return the response with sliders that are bent so, if it is found.

        From a ``guess``, or from here.
        """
        guess = self.point if guess is None else guess
        return Reached.by(self.balance, bent, guess, self.rows, self.tolerance)

    def changed(self, change: Array) -> Reached | None:
        """Return the response with changed tractions [N], shape (stuck,), if found."""
        guess = self.point + self.leeway.changes @ change
        return self.bent_by(self.leeway.stuck.bent(change), guess)

    def moved(self, change: Array) -> Reached | None:
        """Return the response with changed tractions [N], or with a part of that."""
        made = (self.changed(part * change) for part in PARTS)
        return next((each for each in made if each is not None), None)
