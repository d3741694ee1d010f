"""Newton corrector on a bordered system; knows no physics (theory §6.2)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from scipy.linalg import blas

from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import Linearised, SingularError, System
from microslip_mechanics.arrays import Array, largest

ROUNDING = 1e-8
"""relative size of a step that cannot lower the residual because of rounding"""
HALVINGS = 12
"""of a step, at the most"""
STUCK = 10.0
"""times what does not matter: a step of that size that does not lower the residual is
taken to meet a small jump of it, and is good enough where iterations run out"""
LOWERS = 1e-4
"""share of a residual by which a whole step lowers it at least"""
HARDLY = 0.9
"""share of a residual, more of which idle steps leave together"""
CHORD = 0.1
"""contraction that shows that the Jacobian has hardly changed"""


class Small(NamedTuple):
    """What does not matter near a solution."""

    changes: Callable[[Array], Array]
    """point (n + 1,) ↦ changes of its components that do not matter"""
    residual: float
    """largest residual with which a point may be taken for a solution"""


def correct(
    system: System,
    predicted: Array,
    normal: Array,
    *,
    tolerance: float,
    small: Small | None = None,
    max_iterations: int = 25,
    chord: float = CHORD,
    idle: int | None = None,
) -> Correction:
    """Bring a predicted point to the curve, within the plane normal to ``normal``.

    Parameters
    ----------
    system
        Residual and Jacobian.
    predicted
        First guess, shape ``(n + 1,)``; the plane goes through it.
    normal
        Row that borders the Jacobian, shape ``(n + 1,)``.
    tolerance
        Of the largest residual.
    small
        What does not matter: a whole step whose components, over its changes, have a
        norm up to one is the last. None if left out.
    max_iterations
        Newton steps before the correction gives up.
    chord
        Share of the residual that a step leaves, below which its factors serve again.
    idle
        Newton steps in a row that may hardly lower the residual; any number if left
        out.

    Notes
    -----
    A step that does not lower the Euclidean norm of the residual is halved.
    """
    point = predicted
    residual, linearised = system(point)
    slope = linearised
    sizes, stuck = [largest(residual)], False

    def ended(outcome: Outcome) -> Correction:
        return Correction(point, residual, linearised, outcome, tuple(sizes))

    while True:
        outcome = _outcome(sizes, tolerance, max_iterations, stuck, idle)
        if outcome is not None:
            return ended(outcome)
        try:
            step = slope.solve(normal, np.append(residual, 0.0))
        except SingularError:
            return ended(Outcome.SINGULAR)
        stuck = _within(step, point, sizes[-1], small, STUCK)
        older = slope is not linearised
        attempts = 1 if stuck or older else HALVINGS
        lowered = _lowered(system, point, residual, step, attempts)
        if lowered is None and older:
            slope = linearised
            continue
        if lowered is None:
            return ended(Outcome.CONVERGED if stuck else Outcome.STALLED)
        point, residual, linearised, share, part = lowered
        slope = slope if share < chord else linearised
        sizes.append(largest(residual))
        if part == 1.0 and _negligible(step, point, sizes[-1], small, 1.0):
            return ended(Outcome.CONVERGED)


class Lowered(NamedTuple):
    """What a step that lowers the residual has led to."""

    point: Array
    residual: Array
    linearised: Linearised
    share: float
    """of the residual that is left"""
    part: float
    """of the step that was taken"""


def _lowered(
    system: System, point: Array, residual: Array, step: Array, attempts: int
) -> Lowered | None:
    """Return where the largest part of a step leads that lowers the residual.

    It is halved until it does; None if it does not after so many ``attempts``.
    """
    merit = _merit(residual)
    for halving in range(attempts):
        part = 0.5**halving
        trial = point - part * step
        tried, derivative = system(trial)
        share = _merit(tried) / merit
        if share < 1.0 - LOWERS * part:
            return Lowered(trial, tried, derivative, share, part)
    return None


def _outcome(
    sizes: list[float],
    tolerance: float,
    max_iterations: int,
    stuck: bool,
    idle: int | None,
) -> Outcome | None:
    """Return how a correction has ended; None if it has not.

    Where iterations run out, a last step that was ``stuck`` is good enough.
    """
    if not np.isfinite(sizes[-1]):
        return Outcome.OVERFLOW
    if sizes[-1] <= tolerance:
        return Outcome.CONVERGED
    if idle and len(sizes) > idle and sizes[-1] > HARDLY * sizes[-1 - idle]:
        return Outcome.STALLED
    if len(sizes) <= max_iterations:
        return None
    return Outcome.CONVERGED if stuck else Outcome.EXHAUSTED


def _within(
    step: Array, point: Array, size: float, small: Small | None, times: float
) -> bool:
    """Return whether a step changes nothing that matters, or rounding only."""
    if _merit(step) <= ROUNDING * _merit(point[:-1]):
        return True
    return _negligible(step, point, size, small, times)


def _negligible(
    step: Array, point: Array, size: float, small: Small | None, times: float
) -> bool:
    """Return whether a step changes nothing that matters, near a solution.

    ``size`` is that of the residual.
    """
    if small is None or size > small.residual:
        return False
    return _merit(step / small.changes(point)) <= times


def _merit(values: Array) -> float:
    """Return the Euclidean norm, which a step must lower; infinite if it overflows."""
    return math.sqrt(blas.ddot(values, values)) if values.size else 0.0
