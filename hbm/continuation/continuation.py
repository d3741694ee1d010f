"""Pseudo-arc-length continuation as a generator; knows no physics (theory §6.2)."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from hbm.continuation.arc import Metric, tangent, turn
from hbm.continuation.arc_step import next_point
from hbm.continuation.border import border
from hbm.continuation.corrected import correct_at
from hbm.continuation.correction import Correction
from hbm.continuation.linearised import SingularError, System
from hbm.continuation.predictor import Predictor
from hbm.continuation.settler import UNSETTLED, Settler
from hbm.continuation.step_control import StepControl
from hbm.continuation.trail import Trail
from hbm.errors import PLACE, ContinuationError
from microslip_mechanics.arrays import Array

TURNS, FEW = 3, 10.0
"""sharp turns that may be made while steps are shortest, or so many times as long"""


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
    trail: Trail | None = None,
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
    trail
        The curve up to ``start``, if it has turned round a corner there.
    metric
        Scale of each component, by which arc length is measured near a point.
    control
        Steps and tolerance.
    settler
        Is given each converged point; may return a better one.

    Raises
    ------
    ContinuationError
        If the first point or, after the shortest step, a later one does not converge,
        if shortest steps turn sharply again and again, or if the curve comes back to
        where it has been but not to its beginning.
    """
    at = partial(correct_at, system, control=control, settler=settler, metric=metric)
    accepted = at(start)
    begin = float(start[-1]) if begin is None else begin
    if direction is None:
        direction = np.zeros_like(start)
        direction[-1] = math.copysign(1.0, end - begin)
    scale = metric(accepted.point)
    along = _begun(accepted, direction, scale)
    accepted = replace(accepted, tangent=along, joined=False)
    accepted.linearised.forget()
    yield accepted
    limits = min(begin, end), max(begin, end)
    past, step, went, sharp = Predictor(), control.initial, 0.0, 0
    trail = trail or Trail(system, control)
    for _ in range(control.most_points):
        trail.append(accepted)
        missed = past.append(accepted.point, along, scale, went)
        if went > 0.0:
            step = control.after(went, missed, past.order, accepted.iterations)
        candidate, went = next_point(system, past, step, control, settler)
        sharp = _sharp(sharp, past, candidate, went, control)
        if not limits[0] < candidate.point[-1] < limits[1]:
            yield border(accepted, candidate, limits, at, scale)
            return
        if trail.comes_back(candidate.point, scale):
            yield replace(at(trail.first.point), tangent=trail.first.tangent)
            return
        scale = metric(candidate.point)
        along = candidate.along / float(np.linalg.norm(candidate.along / scale))
        accepted = replace(candidate, tangent=along, joined=True)
        yield accepted
    raise ContinuationError(
        f"the curve has not come to an end after {control.most_points} points, at "
        f"{PLACE}: a shorter range or a larger step helps",
        float(accepted.point[-1]),
    )


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


def _sharp(
    before: int,
    past: Predictor,
    candidate: Correction,
    went: float,
    control: StepControl,
) -> int:
    """Return how many sharp turns were made since steps are about the shortest.

    ``before`` is their number up to the last point, ``went`` the step from there.

    Raises
    ------
    ContinuationError
        If they are too many: beyond a corner the curve may go on against the tangent
        that continuity would have, and steps along that one come back.
    """
    if went > FEW * control.smallest:
        return 0
    sharp = turn(candidate, past.tangent, past.scale) <= control.sharpest_turn
    made = before + int(sharp)
    if made > TURNS:
        raise ContinuationError(
            f"the curve turns sharply at {PLACE}, where a contact changes its state: "
            "more harmonics or more samples make it smoother",
            float(candidate.point[-1]),
        )
    return made
