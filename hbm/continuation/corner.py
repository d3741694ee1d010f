"""Corners of a curve: where a contact changes its state, it may turn sharply (§6.2).

Where a slider begins to slip or a stop to touch, the derivative of the residual jumps.
If the curve before and behind makes an acute angle, no plane across the first part
meets the second, however short the step. The second part has its tangent from the
derivative on its own side, and leads away against what continuity would have.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from hbm.continuation.arc import Metric, distance, plane_across, tangent
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import SingularError, System
from hbm.continuation.newton import correct
from microslip_mechanics.arrays import Array

BEYOND = (0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3)
"""arc lengths past the last point, at which the other side is sought"""
NEAR, FAR = 1e-3, 1e-2
"""arc length of the way to the corner, by which its direction is known: at least, and
from which on no more is needed"""
STEPS = (1e-3, 1e-4, 1e-2, 1e-5)
"""arc lengths along the other side, tried in turn"""
ITERATIONS = 8
"""of Newton's for such a step, which is nearly straight"""
ASIDE = 0.2
"""of such a step, by which a correction may leave it"""
STRAIGHT = 0.99
"""cosine of the angle between two ways, from which on they are one"""


class Turned(NamedTuple):
    """What is behind a corner."""

    point: Array
    """of the curve, shape (n + 1,)"""
    direction: Array
    """in which it goes on, shape (n + 1,)"""
    folds: bool
    """whether its parameter turns back at the corner"""


def round_corner(
    system: System,
    way: Sequence[Correction],
    metric: Metric,
    tolerance: float,
    has_been_at: Callable[[Array, Array], bool] = lambda *_: False,
) -> Turned | None:
    """Return where and how the curve goes on behind a corner; None if there is none.

    Parameters
    ----------
    system
        Residual and Jacobian.
    way
        Points up to the corner, with their tangents.
    metric
        Scale of each component near a point.
    tolerance
        Of the largest residual.
    has_been_at
        Point and scale ↦ whether the curve has been there: it does not lead there.
    """
    last = way[-1]
    scale = metric(last.point)
    back = _back(way, scale)
    if back is None or not last.along.any():
        return None
    along = last.along / float(np.linalg.norm(last.along / scale))
    tried: list[Array] = []
    for beyond in BEYOND:
        try:
            _, linearised = system(last.point + beyond * along)
            onwards = -tangent(linearised, along, scale)
        except SingularError:
            continue
        if any(_along(onwards, each, scale) for each in (back, *tried)):
            continue
        tried.append(onwards / scale)
        found = _stepped(system, last.point, onwards, scale, tolerance)
        if found is None or _along(found - last.point, back, scale):
            continue
        if not has_been_at(found, scale):
            return Turned(found, onwards, bool(back[-1] * onwards[-1] > 0.0))
    return None


def _back(way: Sequence[Correction], scale: Array) -> Array | None:
    """Return the unit direction of the way back, in the metric; None if not known.

    Of a short way it is that in which it has begun.
    """
    begun = way[0].along / scale
    direction = -begun / float(np.linalg.norm(begun)) if begun.any() else None
    for before in reversed(way):
        chord = (before.point - way[-1].point) / scale
        length = float(np.linalg.norm(chord))
        if length >= NEAR:
            direction = chord / length
        if length >= FAR:
            break
    return direction


def _along(step: Array, way: Array, scale: Array) -> bool:
    """Return whether a step takes a way, a unit vector in the metric."""
    taken = step / scale
    return float(taken @ way) > STRAIGHT * float(np.linalg.norm(taken))


def _stepped(
    system: System, start: Array, direction: Array, scale: Array, tolerance: float
) -> Array | None:
    """Return a point of the curve a little way in a direction; None if none is near."""
    normal = plane_across(direction, scale)
    for step in STEPS:
        predicted = start + step * direction
        found = correct(
            system, predicted, normal, tolerance=tolerance, max_iterations=ITERATIONS
        )
        near = distance(found.point, predicted, scale) <= ASIDE * step
        if near and found.outcome is Outcome.CONVERGED:
            return found.point
    return None
