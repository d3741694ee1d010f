"""Pseudo-arc-length continuation as a generator; knows no physics (theory §6)."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from hbm.errors import PLACE, ContinuationError
from hbm.newton import (
    Correction,
    Linearised,
    Outcome,
    SingularError,
    Small,
    System,
    correct,
)
from hbm.predictor import Predictor
from hbm.settler import UNSETTLED, Settler
from hbm.step_control import StepControl
from microslip_mechanics.arrays import Array

FEWEST = 4
"""steps of a closed curve"""
ASIDE = 0.1
"""length of a step from which it may pass a point, over its own"""

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

    A closed curve ends with the point at which it began.

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
    accepted = correct_at(system, start, control, settler, metric)
    step = control.initial
    begin = float(start[-1]) if begin is None else begin
    if direction is None:
        direction = np.zeros_like(start)
        direction[-1] = math.copysign(1.0, end - begin)
    scale = metric(accepted.point)
    direction = _begun(accepted, direction, scale)
    first = accepted = replace(accepted, tangent=direction, joined=False)
    yield accepted
    low, high = sorted((begin, end))
    past, went = Predictor(), 0.0
    for number in range(control.most_points):
        missed = past.append(accepted.point, direction, scale, went)
        if went > 0.0:
            step = control.after(went, missed, past.order, accepted.iterations)
        candidate, went = _next(system, past, direction, scale, step, control, settler)
        if not low < candidate.point[-1] < high:
            limits = (low, high)
            yield _border(system, accepted, candidate, limits, control, settler, metric)
            return
        if number >= FEWEST and _passes(first, accepted, candidate, scale):
            closed = correct_at(system, first.point, control, settler, metric)
            yield replace(closed, tangent=first.tangent)
            return
        scale = metric(candidate.point)
        direction = candidate.along / float(np.linalg.norm(candidate.along / scale))
        accepted = replace(candidate, tangent=direction, joined=True)
        yield accepted
    raise ContinuationError(
        f"the curve has not come to an end after {control.most_points} points, at "
        f"{PLACE}: a shorter range or a larger step helps",
        float(accepted.point[-1]),
    )


def correct_at(
    system: System,
    guess: Array,
    control: StepControl,
    settler: Settler = UNSETTLED,
    metric: Metric | None = None,
) -> Correction:
    """Correct a guess at its own parameter.

    With a ``metric`` steps that :class:`StepControl` neglects end the iteration.

    Raises
    ------
    ContinuationError
        If it does not converge.
    """
    normal = np.zeros_like(guess)
    normal[-1] = 1.0
    small = _small(control, metric)
    found = correct(
        system,
        guess,
        normal,
        tolerance=control.tolerance,
        small=small,
        max_iterations=60,
    )
    if found.outcome is Outcome.CONVERGED:
        found = settler.settle(found, normal, control.tolerance, small)
        settler.keep()
    if found.outcome is not Outcome.CONVERGED:
        raise _lost("no response is found", float(guess[-1]), found, control)
    return found


def _small(control: StepControl, metric: Metric | None) -> Small | None:
    """Return what a step of Newton's iteration may neglect, if it may."""
    if metric is None or control.negligible == 0.0:
        return None
    return Small(lambda point: control.negligible * metric(point), control.loose)


def _begun(first: Correction, direction: Array, scale: Array) -> Array:
    """Return the unit tangent at the first point.

    Raises
    ------
    ContinuationError
        If there is none: the point lies on a fold or on a branch point.
    """
    try:
        return tangent(first.linearised, direction, scale)
    except SingularError:
        raise ContinuationError(
            f"the curve cannot begin at {PLACE}: it folds or branches there; begin a "
            "little beside it",
            float(first.point[-1]),
        ) from None


def _passes(
    first: Correction, before: Correction, after: Correction, scale: Array
) -> bool:
    """Return whether a step passes the first point in its direction."""
    step = (after.point - before.point) / scale
    away = (first.point - before.point) / scale
    length = float(np.linalg.norm(step))
    share = float(step @ away) / length**2
    aside = float(np.linalg.norm(away - share * step))
    same = float((first.along / scale) @ step) > 0.5 * length
    return 0.0 < share <= 1.0 and aside < ASIDE * length and same


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
        candidate, close = _settled(
            system, predicted, normal, scale, step, control, settler
        )
        candidate = _directed(candidate, direction, scale)
        if candidate.outcome is Outcome.CONVERGED:
            cosine = float((candidate.along / scale) @ (direction / scale))
            if (close and cosine > control.sharpest_turn) or step <= control.smallest:
                settler.keep()
                return candidate, step
        elif step <= control.smallest:
            where = float(past.predict(0.0)[-1])
            raise _lost("the curve does not go on", where, candidate, control)
        else:
            failures += 1
        settler.retreat(failures)
        if step < 0.1 * control.largest:
            past.order = 1
        step = max(step * 0.5, control.smallest)


def _settled(
    system: System,
    predicted: Array,
    normal: Array,
    scale: Array,
    step: float,
    control: StepControl,
    settler: Settler,
) -> tuple[Correction, bool]:
    """Return a point across a prediction, settled if it is close to it, and whether.

    If settling moves it far away, to another branch perhaps, and the system that this
    has made finer has a point close to the prediction, that one is taken.
    """
    small = _small(control, lambda _: scale)

    def found() -> tuple[Correction, bool]:
        candidate = correct(
            system, predicted, normal, tolerance=control.tolerance, small=small
        )
        slack = control.shift if settler.changed else control.slack
        near = away(candidate) <= max(0.5 * step, slack)
        return candidate, near and candidate.outcome is Outcome.CONVERGED

    def away(candidate: Correction) -> float:
        return float(np.linalg.norm((candidate.point - predicted) / scale))

    candidate, close = found()
    if not close:
        return candidate, False
    settled = settler.settle(candidate, normal, control.tolerance, small)
    if away(settled) > max(0.5 * step, control.shift):
        again, close = found()
        if close:
            settled = settler.settle(again, normal, control.tolerance, small)
    return settled, True


def _directed(candidate: Correction, direction: Array, scale: Array) -> Correction:
    """Return a converged point with its tangent; failed, if it has none."""
    if candidate.outcome is not Outcome.CONVERGED:
        return candidate
    try:
        turned = tangent(candidate.linearised, direction, scale)
    except SingularError:
        return replace(candidate, outcome=Outcome.SINGULAR)
    return replace(candidate, tangent=turned)


def _border(
    system: System,
    accepted: Correction,
    candidate: Correction,
    limits: tuple[float, float],
    control: StepControl,
    settler: Settler,
    metric: Metric,
) -> Correction:
    """Return the point exactly on the limit that lies between two points."""
    limit = limits[0] if candidate.point[-1] <= limits[0] else limits[1]
    before, after = accepted.point[-1], candidate.point[-1]
    share = (limit - before) / (after - before)
    guess = accepted.point + share * (candidate.point - accepted.point)
    guess[-1] = limit
    found = correct_at(system, guess, control, settler, metric)
    return replace(found, tangent=candidate.tangent)


def _lost(
    what: str, where: float, failed: Correction, control: StepControl
) -> ContinuationError:
    return ContinuationError(
        f"{what} at {PLACE}: {failed.outcome.value} "
        f"(residual {failed.residuals[-1]:.1e} after {failed.iterations} iterations, "
        f"tolerance {control.tolerance:.1e}); more harmonics, more samples or a larger "
        "threshold velocity make it smoother",
        where,
    )
