"""The steady state of any method that marches periods: Broyden's iteration.

A method is its map of a motion at phase 0 to the one some whole periods later. Newton's
iteration on its fixed point takes one derivative, by differences of a cheap march of
the same equations, for all methods; Broyden's updates turn it into the method's own.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.problem import Problem
from timedomain.record.start import Start

ITERATIONS = 25
CLOSED = 1e-10
"""last change of the state over the vibration, at which the iteration ends"""
STALLED = 6
"""iterations without a smaller change, at which it ends too"""
NEUTRAL = 1e-9
"""of the largest singular value of 1 − Φ: below it a direction stays where it is"""
NUDGE = 1e-6
"""of differences, over the vibration"""


class Marched(Protocol):
    """What a map returns."""

    @property
    def end(self) -> Start:
        """The motion at the end."""


Made = TypeVar("Made", bound=Marched)


@dataclass(frozen=True, slots=True)
class Coordinates:
    """States (ω R u, R v, tractions) with Rᵀ R = M, whose square is twice an energy."""

    root: Array
    """R, shape (dofs, dofs)"""
    frequency: float
    """ω [rad/s]"""
    sliders: NDArray[np.int64]
    """places of the points that remember"""
    unit: float
    """of a traction [N], over that of a state"""
    points: int

    @classmethod
    def of(cls, problem: Problem, frequency: float, vibration: float) -> Coordinates:
        """Return coordinates in which a vibration has about this norm."""
        points = problem.interface.points
        sliders = np.flatnonzero(remembers(points))
        unit = problem.force_scale / max(vibration, TINY)
        root = np.linalg.cholesky(problem.structure.dense.mass).T
        return cls(root, frequency, sliders, unit, points.load.size)

    def state(self, start: Start) -> Array:
        """Return a motion as a state."""
        held: Array = np.zeros(2 * self.sliders.size)
        if start.traction is not None:
            held = start.traction[self.sliders].ravel() / self.unit
        moved = self.frequency * (self.root @ start.displacement)
        return np.concatenate([moved, self.root @ start.velocity, held])

    def start(self, state: Array) -> Start:
        """Return a state as a motion."""
        dofs = len(self.root)
        moved, moving, held = np.split(state, [dofs, 2 * dofs])
        traction = np.zeros((self.points, 2))
        traction[self.sliders] = self.unit * held.reshape(-1, 2)
        return Start(
            np.linalg.solve(self.root, moved) / self.frequency,
            np.linalg.solve(self.root, moving),
            traction if self.sliders.size else None,
        )


@dataclass(frozen=True, slots=True)
class Slope:
    """Derivative of a map of one period near its fixed point."""

    coordinates: Coordinates
    derivative: Array
    """Φ, shape (states, states)"""
    vibration: float
    """norm of a state's vibration"""

    @property
    def slowest(self) -> float:
        """Largest modulus of a multiplier, without directions that stay."""
        sizes = np.abs(np.linalg.eigvals(self.derivative))
        return float(sizes[sizes < 1.0 - 1e-7].max(initial=0.0))

    def periods(self, error: float) -> int:
        """Return after how many periods a transient of order one is below an error."""
        rate = self.slowest
        if not 0.0 < error < 1.0 or rate == 0.0:
            return 1
        return max(1, math.ceil(math.log(error) / math.log(rate)))

    def inverse(self, periods: int) -> Array:
        """Return (1 − Φ^periods)⁻¹, zero in directions that stay."""
        whole = np.eye(len(self.derivative))
        power = np.linalg.matrix_power(self.derivative, periods)
        found: Array = np.linalg.pinv(whole - power, rcond=NEUTRAL)
        return found


def slope_of(
    coordinates: Coordinates,
    carried: Callable[[Start], Marched],
    start: Start,
    vibration: float,
) -> Slope:
    """Return the derivative of a map of one period by differences."""
    state = coordinates.state(start)
    nudge = NUDGE * vibration
    before = coordinates.state(carried(start).end)
    columns = np.empty((state.size, state.size))
    for place in range(state.size):
        moved = state.copy()
        moved[place] += nudge
        end = carried(coordinates.start(moved)).end
        columns[:, place] = (coordinates.state(end) - before) / nudge
    return Slope(coordinates, columns, vibration)


@dataclass(frozen=True, slots=True)
class Steady(Generic[Made]):
    """The steady state of a method, as near as it was come to."""

    made: Made
    """what the map returned there"""
    left: float
    """estimated distance from the steady state, over the vibration"""


def steady(
    slope: Slope, carried: Callable[[Start], Made], start: Start, periods: int
) -> Steady[Made]:
    """Return the fixed point of a map of some periods near a start.

    Parameters
    ----------
    slope
        Derivative of a map of one period, of whatever method.
    carried
        The map of ``periods`` periods.
    start
        A motion at phase 0.
    """
    coordinates, inverse = slope.coordinates, slope.inverse(periods)
    state = coordinates.state(start)
    best: Steady[Made] | None = None
    change = gap = np.zeros(0)
    since = 0
    for _ in range(ITERATIONS):
        made = carried(coordinates.start(state))
        fresh = coordinates.state(made.end) - state
        if change.size:
            inverse = _updated(inverse, change, gap - fresh)
        gap, change = fresh, inverse @ fresh
        left = float(np.linalg.norm(change)) / slope.vibration
        since += 1
        if best is None or left < best.left:
            best, since = Steady(made, left), 0
        if best.left <= CLOSED or since >= STALLED or not math.isfinite(left):
            break
        state = state + change
    assert best is not None
    return best


def _updated(inverse: Array, change: Array, answer: Array) -> Array:
    """Return the inverse after Broyden's update: it takes ``answer`` to ``change``."""
    row = change @ inverse
    size = float(row @ answer)
    if abs(size) < TINY:
        return inverse
    changed: Array = inverse + np.outer(change - inverse @ answer, row) / size
    return changed
