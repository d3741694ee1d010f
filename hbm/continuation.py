"""Pseudo-arc-length continuation as a generator; knows no physics (theory §6)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Protocol

import numpy as np

from hbm.newton import Correction, Linearised, Outcome, System, correct
from hbm.predictor import Predictor
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
    miss: float = 0.005
    """by which a predicted point may be wrong"""
    many_iterations: int = 6
    slack: float = 0.01
    """distance by which a correction may leave the prediction in any case"""
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

    def after(self, step: float, missed: float, order: int, iterations: int) -> float:
        """Return the next step.

        It grows or shrinks so that the extrapolation misses the next point by
        :attr:`miss`; it shrinks if Newton's iteration was slow all the same.

        Parameters
        ----------
        step, missed
            Last step, and by how much extrapolation missed the point there.
        order
            Of the extrapolation.
        iterations
            Of Newton.
        """
        factor = math.pow(self.miss / max(missed, 1e-9), 1.0 / (order + 1))
        if iterations > self.many_iterations:
            factor = min(factor, 0.7)
        return min(max(step * min(max(factor, 0.3), 2.0), self.smallest), self.largest)


class Settler(Protocol):
    """What makes a converged point good enough to keep."""

    def settle(
        self, correction: Correction, normal: Array, tolerance: float
    ) -> Correction:
        """Return the point to keep, in the plane normal to ``normal``; it may fail."""

    def keep(self) -> None:
        """Learn that the last point is kept."""

    def retreat(self, times: int) -> None:
        """Learn that the last point was not kept, for the n-th time in a row."""


class Unsettled:
    """Keeps each point as it is."""

    def settle(
        self,
        correction: Correction,
        normal: Array,  # noqa: ARG002
        tolerance: float,  # noqa: ARG002
    ) -> Correction:
        """Return the point."""
        return correction

    def keep(self) -> None:
        """Do nothing."""

    def retreat(self, times: int) -> None:
        """Do nothing."""


UNSETTLED = Unsettled()

Metric = Callable[[Array], Array]
"""point (n + 1,) ↦ the change of each component that counts as one unit of arc"""


def trace(
    system: System,
    start: Array,
    end: float,
    *,
    metric: Metric,
    control: StepControl,
    settler: Settler = UNSETTLED,
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
    settler
        Is given each converged point; may return a better one.

    Raises
    ------
    ContinuationError
        If the first point or, after the shortest step, a later one does not converge.
    """
    accepted, step = correct_at(system, start, control, settler), control.initial
    begin = float(start[-1]) if begin is None else begin
    if direction is None:
        direction = np.zeros_like(start)
        direction[-1] = math.copysign(1.0, end - begin)
    scale = metric(accepted.point)
    direction = tangent(accepted.linearised, direction, scale)
    accepted = replace(accepted, tangent=direction)
    yield accepted
    low, high = sorted((begin, end))
    past, went = Predictor(), 0.0
    while True:
        missed = past.append(accepted.point, direction, scale, went)
        if went > 0.0:
            step = control.after(went, missed, past.order, accepted.iterations)
        candidate, went = _next(system, past, direction, scale, step, control, settler)
        if not low < candidate.point[-1] < high:
            yield _border(system, accepted, candidate, (low, high), control, settler)
            return
        scale = metric(candidate.point)
        direction = candidate.along / float(np.linalg.norm(candidate.along / scale))
        accepted = replace(candidate, tangent=direction)
        yield accepted


def correct_at(
    system: System, guess: Array, control: StepControl, settler: Settler = UNSETTLED
) -> Correction:
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
    if found.outcome is Outcome.CONVERGED:
        found = settler.settle(found, normal, control.tolerance)
        settler.keep()
    if found.outcome is not Outcome.CONVERGED:
        raise ContinuationError(_text(float(guess[-1]), found, control))
    return found


def tangent(linearised: Linearised, direction: Array, scale: Array) -> Array:
    """Return the unit tangent (in the metric) that goes on along ``direction``.

    Raises
    ------
    SingularError
        If the curve does not go on along it.
    """
    right = np.zeros(direction.size)
    right[-1] = 1.0
    along = linearised.solve(direction / scale**2, right)
    unit: Array = along / float(np.linalg.norm(along / scale))
    return unit


def _next(
    system: System,
    past: Predictor,
    direction: Array,
    scale: Array,
    step: float,
    control: StepControl,
    settler: Settler,
) -> tuple[Correction, float]:
    """Return the next point and the step that led to it."""
    normal = direction / scale**2
    normal /= np.abs(normal).max()
    failures = 0
    while True:
        predicted = past.predict(step)
        candidate = correct(system, predicted, normal, tolerance=control.tolerance)
        moved = float(np.linalg.norm((candidate.point - predicted) / scale))
        close = moved <= max(0.5 * step, control.slack)
        if candidate.outcome is Outcome.CONVERGED and close:
            candidate = settler.settle(candidate, normal, control.tolerance)
        if candidate.outcome is Outcome.CONVERGED:
            turned = tangent(candidate.linearised, direction, scale)
            cosine = float((turned / scale) @ (direction / scale))
            if (close and cosine > control.sharpest_turn) or step <= control.smallest:
                settler.keep()
                return replace(candidate, tangent=turned), step
        elif step <= control.smallest:
            where = float(past.predict(0.0)[-1])
            raise ContinuationError(_text(where, candidate, control))
        else:
            failures += 1
        settler.retreat(failures)
        if step < 0.1 * control.largest:
            past.order = 1
        step = max(step * 0.5, control.smallest)


def _border(
    system: System,
    accepted: Correction,
    candidate: Correction,
    limits: tuple[float, float],
    control: StepControl,
    settler: Settler,
) -> Correction:
    """Return the point exactly on the limit that lies between two points."""
    limit = limits[0] if candidate.point[-1] <= limits[0] else limits[1]
    before, after = accepted.point[-1], candidate.point[-1]
    share = (limit - before) / (after - before)
    guess = accepted.point + share * (candidate.point - accepted.point)
    guess[-1] = limit
    found = correct_at(system, guess, control, settler)
    return replace(found, tangent=candidate.tangent)


def _text(where: float, failed: Correction, control: StepControl) -> str:
    return (
        f"the curve does not go on at parameter {where:.9g}: {failed.outcome.value} "
        f"(residual {failed.residuals[-1]:.1e} after {failed.iterations} iterations, "
        f"tolerance {control.tolerance:.1e}); more harmonics, more samples or a larger "
        "threshold velocity make it smoother"
    )
