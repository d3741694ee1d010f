"""All steps of a period at once: orbits on which no march stays (theory §7.3).

The steps are those of :mod:`timedomain.shooting.period_map`,
s₁ = A s₀ + b (φ₀ + φ₁) + g, but the states at all times are unknowns: no small motion
is carried over the period, however fast it grows.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.contact.slides import slides_of
from microslip_mechanics.contact.spread import spread_force
from microslip_mechanics.jit import kernel
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.shooting.closed_march import (
    CLOSED,
    HALVINGS,
    ITERATIONS,
    ClosedMarch,
    ShootingError,
)
from timedomain.shooting.period_map import Period, PeriodMap
from timedomain.shooting.whole_change import whole_change


def whole_orbit(carried: PeriodMap, near: PeriodicResponse) -> ClosedMarch:
    """Return the orbit of one number of steps near a periodic response.

    It is what :func:`~timedomain.shooting.closed_march.closed` returns, stable or not:
    a march from its state repeats itself until rounding has grown. No contact may
    remember or be rigid.

    Raises
    ------
    ShootingError
        If Newton's iteration does not converge.
    """
    steps = _Steps.of(carried)
    states = steps.sampled(near)
    left = steps.left(states)
    for iteration in range(1, ITERATIONS + 1):
        change = steps.change(states, left)
        small = CLOSED * _norm(states - states.mean(axis=0))
        done = _norm(change) <= small
        states, left = _closer(steps, states, change, left, small)
        if done:
            return steps.closed(states, CLOSED * _norm(left) / small, iteration)
    raise ShootingError(f"{_at(carried)} does not converge in {ITERATIONS} iterations")


def _closer(
    steps: _Steps, states: Array, change: Array, left: Array, small: float
) -> tuple[Array, Array]:
    """Return the states after a change, halved until the steps leave less."""
    for halvings in range(HALVINGS):
        trial = states + 0.5**halvings * change
        after = steps.left(trial)
        if _norm(after) < _norm(left):
            return trial, after
    if _norm(change) <= small:  # rounding is left
        return states, left
    raise ShootingError(
        f"{_at(steps.carried)}: no change of all of them leaves less: there may be no "
        "orbit near the start; give a closer one"
    )


@dataclass(frozen=True, slots=True)
class _Steps:
    """The steps of a period."""

    carried: PeriodMap
    free: Array
    """A, shape (2 modes, 2 modes)"""
    push: Array
    """b, shape (2 modes, rank)"""
    loads: Array
    """g of each step, shape (steps, 2 modes)"""

    @classmethod
    def of(cls, carried: PeriodMap) -> _Steps:
        """Return the steps of a map of the period."""
        structure, loads = carried.structure, carried.problem.loads
        free, push = carried.step(-structure.selection.T)
        _, shaken = carried.step(structure.shapes.T @ loads.T)
        period = math.tau / carried.frequency
        times = period * np.arange(carried.steps + 1) / carried.steps
        drive = Dwell(carried.frequency, period).segments()
        factors = factors_over(drive, times, len(loads))
        return cls(carried, free, push, (factors[1:] + factors[:-1]) @ shaken.T)

    def sampled(self, near: PeriodicResponse) -> Array:
        """Return a response as states at all times, shape (steps, 2 modes)."""
        phase = math.tau * np.arange(self.carried.steps) / self.carried.steps
        displacement, velocity = near.at(phase)
        moving = velocity / self.carried.frequency
        inverse = self.carried.structure.inverse.T
        return np.hstack([displacement @ inverse, moving @ inverse])

    def left(self, states: Array) -> Array:
        """Return what each step leaves, s₁ − A s₀ − b (φ₀ + φ₁) − g."""
        forces, _ = self._forces(*self._points(self._motion(states)))
        pushed = (forces + np.roll(forces, -1, axis=0)) @ self.push.T
        after = np.roll(states, -1, axis=0)
        left: Array = after - states @ self.free.T - pushed - self.loads
        return left

    def change(self, states: Array, left: Array) -> Array:
        """Return Newton's change of all states."""
        motion = self._motion(states)
        tangents = self.carried.tangents(self._points(motion), self.carried.length)
        try:
            with np.errstate(over="raise", invalid="raise"):
                return whole_change(
                    self.free, self.push, self.carried.seen, tangents, left
                )
        except (FloatingPointError, np.linalg.LinAlgError) as error:
            raise ShootingError(
                f"{_at(self.carried)}: small motions grow beyond all numbers within a "
                "few of them: give more steps"
            ) from error

    def closed(self, states: Array, gap: float, iterations: int) -> ClosedMarch:
        """Return the orbit that repeats itself."""
        carried = self.carried
        displacement, velocity = self._motion(np.vstack([states, states[:1]]))
        points = self._points((displacement, velocity))
        _, power = self._forces(*points)
        friction = power[:-1].mean() * math.tau / carried.frequency
        slides = slides_of(carried.sliders, *points, np.zeros(0), carried.frequency)
        period = Period(displacement, velocity, float(friction), slides)
        return ClosedMarch(carried, states[0], period, 0, gap, iterations)

    def _motion(self, states: Array) -> tuple[Array, Array]:
        """Return displacement and velocity, each (times, dofs)."""
        moved, moving = np.hsplit(states, 2)
        shapes = self.carried.structure.shapes.T
        return moved @ shapes, self.carried.frequency * (moving @ shapes)

    def _points(self, motion: tuple[Array, Array]) -> tuple[Array, Array]:
        return self.carried.points(*motion)

    def _forces(self, displacement: Array, velocity: Array) -> tuple[Array, Array]:
        """Return φ, (times, rank), and the power that friction takes, (times,)."""
        forces = np.zeros_like(displacement)
        points, step = self.carried.problem.interface.points, self.carried.length
        _write(points, step, displacement, velocity, forces)
        power = (forces * velocity)[:, :, 1:].sum(axis=(1, 2))
        return forces.reshape(len(forces), -1) @ self.carried.sliders.basis, power


@kernel
def _write(
    points: ContactPoints,
    step: float,
    displacement: Array,
    velocity: Array,
    forces: Array,
) -> None:
    """Write the forces of all points at all times."""
    tangents = np.zeros((5, 3, 3))
    for place in range(forces.shape[0]):
        for point in range(forces.shape[1]):
            spread_force(
                points, point, step, displacement[place, point],
                velocity[place, point], forces[place, point], tangents,
            )  # fmt: skip


def _norm(states: Array) -> float:
    """Return the root of the mean square of states."""
    return float(np.sqrt((states**2).sum(axis=1).mean()))


def _at(carried: PeriodMap) -> str:
    hertz = carried.frequency / math.tau
    return f"shooting at {hertz:.6g} Hz with {carried.steps} steps at once"
