"""Floquet multipliers of maps over a period, by two sizes of steps (theory §7.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import linear_sum_assignment

from microslip_mechanics.arrays import Array, ComplexArray

RESOLVED = 0.1
"""change of a multiplier from half the steps up to which it is extrapolated"""
FALL = 4.0
"""by which twice the steps lower an error at the best"""


@dataclass(frozen=True, slots=True)
class Multipliers:
    """Floquet multipliers and how far they may be wrong."""

    values: ComplexArray
    """by falling modulus, shape (2 dofs,)"""
    error: Array
    """how far extrapolation from steps to half of them moved each, shape (2 dofs,)"""

    def after(self, coarser: Multipliers) -> Multipliers:
        """Return them with errors that are no accident, from those of twice the steps.

        Where both steps err alike the change is small by chance: the least error is
        what a second order leaves of that of the nearest multiplier before.
        """
        if not np.isfinite([self.values, coarser.values]).all():
            return self
        distance = np.abs(self.values[:, None] - coarser.values)
        _, paired = linear_sum_assignment(distance)
        return Multipliers(
            self.values, np.maximum(self.error, coarser.error[paired] / FALL)
        )


def extrapolated_multipliers(coarse: Array, fine: Array) -> Multipliers:
    """Return the multipliers of maps by steps and by half of them, extrapolated.

    The maps are extrapolated, unless the steps do not resolve the fastest motions,
    whose phases are arbitrary then: that would let them grow. Multipliers that changed
    by more than :data:`RESOLVED` are left as they are, the others extrapolated one by
    one. All are infinite where small motions grow beyond all numbers.
    """
    if not np.isfinite([coarse, fine]).all():
        beyond = np.full(len(fine), np.inf)
        return Multipliers(beyond.astype(complex), beyond)
    before = np.linalg.eigvals(coarse)
    values = np.linalg.eigvals(fine + (fine - coarse) / 3.0).astype(complex)
    distance = np.abs(values[:, None] - before)
    each, paired = linear_sum_assignment(distance)
    error = distance[each, paired]
    if error.max(initial=0.0) > RESOLVED:
        values, error = _one_by_one(coarse, fine)
    order = np.argsort(-np.abs(values), kind="stable")
    return Multipliers(values[order], error[order])


def _one_by_one(coarse: Array, fine: Array) -> tuple[ComplexArray, Array]:
    """Return the eigenvalues of the finer map, and how far each was away.

    Those of alike shapes belong together, however far apart they are.
    """
    (before, shapes), (values, motions) = map(np.linalg.eig, (coarse, fine))
    alike = np.abs(motions.conj().T @ shapes)
    _, paired = linear_sum_assignment(-alike)
    moved = values - before[paired]
    error = np.abs(moved)
    found = values + np.where(error <= RESOLVED, moved / 3.0, 0.0)
    return found.astype(complex), error
