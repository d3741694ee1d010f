"""What mean tractions of stuck sliders change of amplitudes, to first order (§6.5).

The farthest that an amplitude goes is a linear programme: the tractions of all such
sliders vary, and none may exceed its limit, which varies with them, at any time of the
period.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import upright
from hbm.curves.stuck_tractions import Effects, StuckTractions
from microslip_mechanics.arrays import TINY, Array, largest
from microslip_mechanics.results.response import measure

WITHIN = 1e-6
"""of what slips have changed, by which a traction is taken to be within its limit"""
KEPT = 1e-10
"""of the largest room, by which a condition may be broken"""
TAKEN = 4
"""conditions that are taken at once, for each traction"""
FEW = 8
"""sliders that stick, of which it is found out what lets them slip, and points, of
which what relieves them: each round of that costs more than the point, where they are
many"""
IDLE = 1e-6
"""of the largest slope: what a smaller one gains is not worth a traction"""
FAINT = 1e-9
"""of the largest change of a depth, up to which another one may be rounding"""


@dataclass(frozen=True)
class Leeway:
    """What mean tractions of stuck sliders change of a point, to first order."""

    stuck: StuckTractions
    changes: Array
    """of the point by each of them, shape (size, stuck)"""
    amplitude: Array
    """of the probes [m], shape (probes,)"""
    slopes: Array
    """of these by each of them [m/N], shape (probes, stuck)"""

    @classmethod
    def of(cls, balance: HarmonicBalance, point: Array, rows: Array) -> Leeway:
        """Return that at a point, at its frequency.

        Raises
        ------
        SingularError
            If the curve turns there.
        """
        balance.residual(point)
        stuck = StuckTractions.of(balance, float(point[-1]))
        # what has slipped into its limits, and sticks there, may go on
        bent = stuck.bent(WITHIN * stuck.slipped(balance.problem.bent))
        free = balance.with_problem(replace(balance.problem, bent=bent))
        _, linearised = free(point)
        pulled = np.zeros((point.size, len(stuck.along)))
        pulled[: balance.rank] = -stuck.along.T
        changes: Array = pulled
        if pulled.size:
            changes = linearised.solve(upright(point), pulled)
        return cls(stuck, changes, *_slopes(balance, point, changes, rows))

    def opens(self, least: float) -> list[int]:
        """Return the probes whose amplitudes may change by that share, or more."""
        most = 2.0 * np.abs(self.slopes) @ self.stuck.limit.max(axis=0)
        open_ = most > least * measure(self.amplitude)
        found: list[int] = np.flatnonzero(open_).tolist()
        return found

    def farthest(self, probe: int, sign: float) -> Array:
        """Return the changes of tractions [N] for the greatest amplitude, (stuck,).

        The least one for a negative ``sign``. No traction changes by more than its
        largest limit.
        """
        slope = sign * self.slopes[probe]
        if not slope.any():
            return np.zeros_like(slope)
        return self._greatest(slope, *self.bounds)

    def loosening(self) -> Array:
        """Return the changes of tractions [N] that let a stuck slider slip, (stuck,).

        Where all stick no amplitude depends on them to first order, but loads do: it is
        the slider that these can relieve of most of what holds it. Zero if they can let
        none slip, or if it is one of more than :data:`FEW`.
        """
        count = len(self.stuck.along)
        if not 0 < count <= FEW:
            return np.zeros(count)
        reliefs = self._effects.reliefs
        most = np.abs(reliefs) @ self.stuck.limit.max(axis=0)
        share = most / np.maximum(self.stuck.spare, TINY)
        if share.max(initial=0.0) <= 1.0:
            return np.zeros(len(share))
        first = int(share.argmax())
        limits = self.stuck.bounds(self._effects, loose=first)
        change = self._greatest(-reliefs[first], *limits)
        lets = -reliefs[first] @ change > self.stuck.spare[first]
        return change if lets else np.zeros_like(change)

    def relieving(self) -> list[Array]:
        """Return changes of tractions [N], each (stuck,), that relieve points the most.

        One for each point whose load follows its motion; none if those, or what sticks,
        are more than :data:`FEW`.
        """
        sliders = self.stuck.sliders
        follows = np.flatnonzero(~sliders.points.constant_load)
        if not 0 < len(self.stuck.along) <= FEW or follows.size > FEW:
            return []
        deeper = sliders.basis[3 * follows] @ self._coefficients[0]
        large = np.abs(deeper).max(axis=1) > FAINT * largest(deeper)
        found = [self._greatest(-each, *self.bounds) for each in deeper[large]]
        return [each for each in found if each.any()]

    @cached_property
    def bounds(self) -> tuple[Array, Array]:
        """The limits of tractions, as matrix · change ≤ room."""
        return self.stuck.bounds(self._effects)

    @cached_property
    def _effects(self) -> Effects:
        return self.stuck.effects(self._coefficients)

    @property
    def _coefficients(self) -> Array:
        """Changes of those of y by each of them, shape (2H + 1, rank, stuck)."""
        count = len(self.stuck.along)
        return self.changes[:-1].reshape(-1, self.stuck.rank, count)

    def _greatest(self, slope: Array, matrix: Array, room: Array) -> Array:
        """Return the changes [N] with the greatest slope · change, shape (stuck,).

        Zero if there is no room.
        """
        if not room.any():
            return np.zeros_like(slope)
        unit, size = largest(room), largest(slope)
        ends = self.stuck.limit.max(axis=0) / unit  # > 0: what has no limit slips
        return unit * _programme(slope / size, matrix, room / unit, ends)


def _programme(slope: Array, matrix: Array, room: Array, ends: Array) -> Array:
    """Return the x with the greatest slope · x, |x| ≤ ends, matrix · x ≤ room.

    Few of the many conditions are met at their ends: those are taken that a solution
    without them does not keep, until it keeps all. Of what is as good the smallest x is
    taken. Zero if there is no solution.
    """
    from scipy.optimize import linprog  # slow to load, and hardly a scene needs it

    # x is what is above zero less what is below, both of which cost a little
    cost = IDLE * np.abs(slope).max() + np.concatenate([-slope, slope])
    bounds = [(0.0, end) for end in (*ends, *ends)]
    both = np.hstack([matrix, -matrix])
    taken = np.zeros(room.size, dtype=bool)
    while True:
        found = linprog(cost, both[taken], room[taken], bounds=bounds)
        if found.x is None:
            return np.zeros_like(slope)
        above, below = np.split(found.x, 2)
        excess = np.where(taken, -np.inf, matrix @ (above - below) - room)
        worst = np.argsort(-excess)[: TAKEN * ends.size]
        worst = worst[excess[worst] > KEPT]
        if not worst.size:
            return np.asarray(above - below)
        taken[worst] = True


def _slopes(
    balance: HarmonicBalance, point: Array, changes: Array, rows: Array
) -> tuple[Array, Array]:
    """Return amplitudes of probes and their derivatives, (probes, causes)."""
    here = balance.motion(point)[1:3] @ rows.T
    amplitude = np.hypot(*here)
    slopes = np.zeros((len(rows), changes.shape[1]))
    for cause, change in enumerate(changes.T):
        moved = balance.motion(point + change)[1:3] @ rows.T - here
        slopes[:, cause] = (here * moved).sum(axis=0)
    slopes /= np.maximum(amplitude, TINY)[:, None]
    return amplitude, slopes
