"""Pseudo-arc-length continuation as a generator; knows no physics (theory §6)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np

from hbm.newton import Correction, Outcome, System, correct
from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError


class ContinuationError(MicroslipError):
    """The curve cannot go on; the text says where, why and what to try."""


@dataclass(frozen=True, slots=True)
class StepControl:
    """Arc-length steps that aim at a fixed number of Newton iterations."""

    initial: float = 0.02
    smallest: float = 1e-7
    largest: float = 0.25
    target_iterations: int = 4
    tolerance: float = 1e-9
    """of the largest residual"""
    sharpest_turn: float = 0.5
    """a step turns the tangent by no more than what has this cosine"""

    def __post_init__(self) -> None:
        """Check the order of the steps."""
        if not 0.0 < self.smallest <= self.initial <= self.largest:
            raise ValueError(
                f"steps {self.smallest:g}, {self.initial:g}, {self.largest:g}: give "
                "0 < smallest <= initial <= largest"
            )
        if self.tolerance <= 0.0:
            raise ValueError(f"tolerance {self.tolerance:g}: give a positive one")

    def after(self, step: float, iterations: int) -> float:
        """Return the next step from the iterations that the last one took."""
        factor = math.exp2(1.0 - iterations / self.target_iterations)
        return min(max(step * factor, self.smallest), self.largest)


Metric = Callable[[Array], Array]
"""point (n + 1,) ↦ the change of each component that counts as one unit of arc"""


def trace(
    system: System,
    start: Array,
    end: float,
    *,
    metric: Metric,
    control: StepControl,
    begin: float | None = None,
    direction: Array | None = None,
) -> Iterator[Correction]:
    """Yield the points of a curve from one value of its parameter to another.

    Parameters
    ----------
    system
        Residual and Jacobian; the last component of a point is the parameter.
    start
        First guess, shape ``(n + 1,)``; it is corrected at its own parameter.
    end
        Parameter at which the curve ends.
    begin
        The other parameter at which the curve ends, if it folds back; that of
        ``start`` if left out.
    direction
        Where to go first, shape ``(n + 1,)``; towards ``end`` if left out.
    metric
        Scale of each component, by which arc length is measured near a point.
    control
        Steps and tolerance.

    Raises
    ------
    ContinuationError
        If the first point or, after the shortest step, a later one does not converge.
    """
    accepted, step = correct_at(system, start, control), control.initial
    yield accepted
    begin = float(start[-1]) if begin is None else begin
    if direction is None:
        direction = np.zeros_like(start)
        direction[-1] = math.copysign(1.0, end - begin)
    low, high = sorted((begin, end))
    while True:
        scale = metric(accepted.point)
        direction = tangent(accepted.jacobian, direction, scale)
        candidate, step = _next(system, accepted, direction, scale, step, control)
        if not low < candidate.point[-1] < high:
            yield _border(system, accepted, candidate, (low, high), control)
            return
        yield candidate
        step = control.after(step, candidate.iterations)
        accepted = candidate


def correct_at(system: System, guess: Array, control: StepControl) -> Correction:
    """Correct a guess at its own parameter.

    Raises
    ------
    ContinuationError
        If it does not converge.
    """
    normal = np.zeros_like(guess)
    normal[-1] = 1.0
    found = correct(
        system, guess, normal, tolerance=control.tolerance, max_iterations=60
    )
    if found.outcome is not Outcome.CONVERGED:
        raise ContinuationError(_text(float(guess[-1]), found, control))
    return found


def tangent(jacobian: Array, direction: Array, scale: Array) -> Array:
    """Return the unit tangent (in the metric) that goes on along ``direction``."""
    bordered = np.vstack([jacobian, direction / scale**2])
    right = np.zeros(direction.size)
    right[-1] = 1.0
    along = np.linalg.solve(bordered, right)
    return along / float(np.linalg.norm(along / scale))


def _next(
    system: System,
    accepted: Correction,
    direction: Array,
    scale: Array,
    step: float,
    control: StepControl,
) -> tuple[Correction, float]:
    """Return the next point and the step that led to it."""
    normal = direction / scale**2
    while True:
        candidate = correct(
            system, accepted.point + step * direction, normal / np.abs(normal).max(),
            tolerance=control.tolerance,
        )  # fmt: skip
        if candidate.outcome is Outcome.CONVERGED:
            turned = tangent(candidate.jacobian, direction, scale)
            if (turned / scale) @ (direction / scale) > control.sharpest_turn:
                return candidate, step
            if step <= control.smallest:
                return candidate, step
        elif step <= control.smallest:
            where = float(accepted.point[-1])
            raise ContinuationError(_text(where, candidate, control))
        step = max(step * 0.5, control.smallest)


def _border(
    system: System,
    accepted: Correction,
    candidate: Correction,
    limits: tuple[float, float],
    control: StepControl,
) -> Correction:
    """Return the point exactly on the limit that lies between two points."""
    limit = limits[0] if candidate.point[-1] <= limits[0] else limits[1]
    before, after = accepted.point[-1], candidate.point[-1]
    share = (limit - before) / (after - before)
    guess = accepted.point + share * (candidate.point - accepted.point)
    guess[-1] = limit
    return correct_at(system, guess, control)


def _text(where: float, failed: Correction, control: StepControl) -> str:
    return (
        f"the curve does not go on at parameter {where:.9g}: {failed.outcome.value} "
        f"(residual {failed.residuals[-1]:.1e} after {failed.iterations} iterations, "
        f"tolerance {control.tolerance:.1e}); more harmonics, more samples or a larger "
        "threshold velocity make it smoother"
    )
