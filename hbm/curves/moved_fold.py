"""Folds that lead to other curves as the drive changes (theory §6.2).

Where two curves meet, a fold of one becomes a fold of the other: followed along the
drive it turns back there, and comes to the wanted drive again on the other curve.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from hbm.balance.rigid import pushed
from hbm.continuation.correction import Outcome
from hbm.continuation.newton import correct
from hbm.curves.branch_point import OFFSETS
from hbm.curves.parameter_curves import fold_curve
from hbm.curves.response import response
from hbm.errors import ContinuationError, drives
from hbm.forces.fourier import FourierBasis
from hbm.options import CurveOptions
from hbm.paths.path import AlongFrequency
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse


@dataclass(frozen=True, slots=True)
class MovedFold:
    """Where a fold has come as the drive changed."""

    share: float
    """drive at which it was seen last, over the wanted one"""
    cause: str
    """why it was not followed to the end of the range; empty if it was"""
    back: PeriodicResponse | None
    """the fold into which it has turned where it comes to the first value again"""


def moved_fold(
    problem_at: Callable[[float], Problem],
    fold: PeriodicResponse,
    options: CurveOptions,
) -> MovedFold:
    """Return where a fold comes; its arguments are those of :func:`fold_curve`."""
    known = replace(fold, shapes=None)
    passed, last, cause = 0, known, ""
    try:
        for point in fold_curve(problem_at, known, options):
            passed, last = passed + 1, point.response
    except ContinuationError as error:
        cause = str(error.placed(drives))
    returned = not cause and passed > 1 and last.parameter == options.start
    return MovedFold(
        last.parameter if passed else options.start, cause, last if returned else None
    )


def beside(
    problem: Problem, path: AlongFrequency, fold: PeriodicResponse, tolerance: float
) -> PeriodicResponse | None:
    """Return a response of the curve a little beside its fold; None if there is none.

    It is sought along the direction that the Jacobian maps to zero, in the plane across
    that, to a residual of ``tolerance`` [N].
    """
    balance = path.balance(FourierBasis(fold.harmonics, fold.samples))
    relative = fold.coefficients @ path.problem.selection.T
    point = pushed(balance, balance.point(relative, fold.frequency))
    _, linearised = balance(point)
    along = np.zeros_like(point)
    places = np.flatnonzero(path.mask(fold.harmonics))
    along[places] = np.linalg.svd(linearised.jacobian)[2][-1]
    size = float(np.linalg.norm(point[path.rank : -1]))
    for offset in (sign * each for each in reversed(OFFSETS) for sign in (1.0, -1.0)):
        guess = point + offset * size * along
        found = correct(balance, guess, along, tolerance=tolerance)
        if found.outcome is Outcome.CONVERGED:
            return response(problem, balance, found)
    return None
