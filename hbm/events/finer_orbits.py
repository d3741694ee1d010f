"""Orbits with more harmonics than a curve has, for their multipliers (theory §6.4)."""

from __future__ import annotations

import numpy as np

from hbm.balance.balance import Balance
from hbm.continuation.arc import upright
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.newton import Small, correct
from hbm.continuation.step_control import StepControl
from hbm.forces.fourier import FourierBasis
from hbm.paths.path_resolution import PathResolution
from microslip_mechanics.arrays import Array

ASIDE = 0.02
"""relative change of the amplitude from which a finer orbit is another one"""
CHORD = 0.5
"""share of the residual that a Newton step leaves, below which its factors serve again:
so many harmonics take longer to factor than many steps"""
IDLE = 4
"""Newton steps in a row that may hardly lower the residual: more lead nowhere"""
SMALL = 1e-6
"""relative change of the motion that Newton's iteration may neglect"""


class FinerOrbits:
    """Finds them along a path; what the last ones have changed begins the next."""

    def __init__(self, resolution: PathResolution, control: StepControl) -> None:
        """Take a path at any resolution, and what Newton's iteration may leave."""
        self.resolution, self._control = resolution, control
        self._changes: dict[FourierBasis, Array] = {}
        """of the last point by its finer orbit, the latest at the end"""

    def finer(
        self, point: Array, fourier: FourierBasis, along: Array | None = None
    ) -> Array | None:
        """Return the orbit with another resolution, if it is found.

        At the same parameter or, with the tangent ``along`` a curve, across that.
        """
        point = self._with_room(point, fourier)
        normal = way = upright(point)
        if along is not None:
            way = self._with_room(along, fourier)
            normal = self.resolution.across(way, point)
        beside = [
            _within(point, change, normal, way) for change in self._likely(fourier)
        ]
        balance = self.resolution.at(fourier)
        guess = _best(balance, [point, *beside])
        found = self._corrected(balance, guess, normal)
        if found.outcome is not Outcome.CONVERGED and guess is not point:
            found = self._corrected(balance, point, normal)
        if found.outcome is not Outcome.CONVERGED or self._another(point, found.point):
            return None
        self._changes.pop(fourier, None)
        self._changes[fourier] = found.point - point
        return found.point

    def _likely(self, fourier: FourierBasis) -> list[Array]:
        """Return the latest changes by that resolution, and by any."""
        latest = dict.fromkeys([fourier, *[*self._changes][-1:]])
        return [self._changes[each] for each in latest if each in self._changes]

    def _another(self, point: Array, finer: Array) -> bool:
        """Return whether a finer orbit is another one."""
        before, after = self.resolution.amplitudes((point, finer))
        return bool(np.abs(after - before).max() > ASIDE * before.max())

    def _corrected(self, balance: Balance, guess: Array, normal: Array) -> Correction:
        """Return what Newton's iteration leads to."""
        vibration = float(np.linalg.norm(guess[self.resolution.rank : -1]))
        changes = np.full_like(guess, SMALL * vibration)
        return correct(
            balance,
            guess,
            normal,
            tolerance=self._control.tolerance,
            small=Small(lambda _: changes, self._control.loose),
            chord=CHORD,
            idle=IDLE,
        )

    def _with_room(self, point: Array, fourier: FourierBasis) -> Array:
        """Return a point with room for all coefficients of a resolution."""
        missing = fourier.coefficients * self.resolution.rank + 1 - point.size
        if missing <= 0:
            return point
        return np.concatenate((point[:-1], np.zeros(missing), point[-1:]))


def _best(balance: Balance, guesses: list[Array]) -> Array:
    """Return the guess with the smallest residual."""
    if len(guesses) == 1:
        return guesses[0]
    return min(guesses, key=lambda each: float(np.linalg.norm(balance(each)[0])))


def _within(point: Array, change: Array, normal: Array, way: Array) -> Array:
    """Return a changed point, moved along a way into the plane through the point.

    What a change has more than the point has room for is left out.
    """
    moved, shared = np.zeros_like(point), min(change.size, point.size) - 1
    moved[:shared], moved[-1] = change[:shared], change[-1]
    changed: Array = point + moved - (normal @ moved) / (normal @ way) * way
    return changed
