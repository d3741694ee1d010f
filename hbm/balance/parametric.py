"""Harmonic balance at one frequency, along a parameter of the problem (theory §6.2)."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from hbm.balance.linearisation import Linearisation
from hbm.balance.relative import RelativeProblem
from hbm.balance.residual import HarmonicBalance
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array

DIFFERENCE = 1e-6
"""of the parameter, over its unit, for the derivative by it"""
PAST = 6
"""parameters that are remembered"""


class ParametricBalance:
    """Residual with a parameter of the problem as the last component of a point.

    Beyond the limits of the parameter, where there need be no problem, the residual
    goes on as it does before them: R(λ) = 2 R(limit) − R(2 limit − λ).
    """

    def __init__(
        self,
        problem_at: Callable[[float], tuple[RelativeProblem, float]],
        fourier: FourierBasis,
        active: NDArray[np.bool_],
        unit: Callable[[float], float],
        limits: tuple[float, float],
    ) -> None:
        """Plan for problems and frequencies that depend on a parameter.

        ``unit`` is the change of the parameter that counts; ``limits`` are the least
        and the largest value of the residual's problems.
        """
        self._problem_at, self.fourier, self._active = problem_at, fourier, active
        self._unit, self._limits = unit, limits
        self._balance: HarmonicBalance | None = None
        self._past: dict[float, HarmonicBalance] = {}

    def __call__(self, point: Array) -> tuple[Array, Linearisation]:
        """Return the residual [N], (size − 1,), and what solves with its Jacobian."""
        here, mirrored = self._reflected(point)
        if mirrored is None:
            return self._inside(here)
        before, falling = self._inside(mirrored)
        residual, linearised = self._inside(here)
        return 2.0 * residual - before, linearised.continued(falling)

    def residual(self, point: Array) -> Array:
        """Return the residual [N], (size − 1,)."""
        here, mirrored = self._reflected(point)
        if mirrored is None:
            return self._residual(here)
        return 2.0 * self._residual(here) - self._residual(mirrored)

    def _reflected(self, point: Array) -> tuple[Array, Array | None]:
        """Return a point, or where it leaves the limits and its mirror image there."""
        border, image = mirrored(float(point[-1]), self._limits)
        if border == point[-1]:
            return point, None
        return np.append(point[:-1], border), np.append(point[:-1], image)

    def _inside(self, point: Array) -> tuple[Array, Linearisation]:
        """Return residual and what solves, with a difference that stays inside."""
        difference = DIFFERENCE * self._unit(float(point[-1]))
        if point[-1] + difference > self._limits[1]:
            difference = -difference
        ahead = point.copy()
        ahead[-1] += difference
        later = self._residual(ahead)
        balance, inner = self.at_frequency(point)
        residual, linearised = balance(inner)
        return residual, linearised.with_slope((later - residual) / difference)

    def _residual(self, point: Array) -> Array:
        balance, inner = self.at_frequency(point)
        return balance.residual(inner)

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses between two orders, last call."""
        if self._balance is None:
            return 0.0
        return self._balance.impulses(above, most)

    def answer(self, point: Array, residual: Array, above: int) -> Array:
        """Return the step with which orders above one answer the residual there.

        That is the last one made.
        """
        here, _ = self._reflected(point)
        balance, inner = self.at_frequency(here)
        return balance.answer(inner, residual, above)

    def at_frequency(self, point: Array) -> tuple[HarmonicBalance, Array]:
        """Return harmonic balance at the point's parameter, and the point for it."""
        parameter = float(point[-1])
        problem, frequency = self._problem_at(parameter)
        if parameter not in self._past:
            while len(self._past) >= PAST:
                self._past.pop(next(iter(self._past)))
            self._past[parameter] = (
                HarmonicBalance(problem, self.fourier, self._active)
                if self._balance is None
                else self._balance.with_problem(problem)
            )
        self._balance = self._past[parameter]
        inner = point.copy()
        inner[-1] = frequency
        return self._balance, inner


def mirrored(parameter: float, limits: tuple[float, float]) -> tuple[float, float]:
    """Return the limit beyond which a parameter is, or itself; its image before that.

    ``limits`` are the least and the largest value.
    """
    border = float(np.clip(parameter, *limits))
    return border, float(np.clip(2.0 * border - parameter, *limits))
