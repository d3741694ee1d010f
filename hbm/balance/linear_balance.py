"""Structure and loads in the balance, without contacts (theory, eqs. 17–18)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.balance.relative import RelativeProblem
from hbm.forces.fourier import to_complex, to_real
from microslip_mechanics.arrays import Array, ComplexArray


class LinearBalance:
    """Dynamic stiffness and load of each order, at one frequency after another."""

    def __init__(self, problem: RelativeProblem, wanted: NDArray[np.bool_]) -> None:
        """Plan for the coordinates that are ``wanted``, shape (orders, rank)."""
        self._problem, self._wanted = problem, wanted
        self._orders = 1j * np.arange(len(wanted))
        self._force = np.zeros((len(wanted), problem.force.shape[1]), complex)
        self._force[:2] = problem.force
        self._load = problem.condensed.loading(problem.force)
        self._at = np.nan
        self._structure: tuple[ComplexArray, ...] = ()

    def at(self, frequency: float) -> tuple[ComplexArray, ...]:
        """Return dynamic stiffness, load and its derivative by s, cached."""
        if frequency != self._at:
            variable = self._orders * frequency
            # only the orders 0 and 1 are loaded
            loads = np.zeros((2, *self._wanted.shape), complex)
            loads[:, :2] = self._load(variable[:2])
            stiffness = self._problem.condensed.dynamic_stiffness(
                variable, self._wanted
            )
            self._structure = (stiffness, *loads)
            self._at = frequency
        return self._structure

    def held(self, frequency: float) -> ComplexArray:
        """Return the dynamic stiffness with what holds free bodies."""
        stiffness = self.at(frequency)[0].copy()
        stiffness[0] += self._problem.gauge
        return stiffness

    def slope(self, coefficients: Array, frequency: float) -> Array:
        """Return the derivative of stiffness times y less load by the frequency.

        It has the shape of the coefficients of y, (2H + 1, rank).
        """
        _, _, load_change = self.at(frequency)
        variable, amplitudes = self._orders * frequency, to_complex(coefficients)
        turned = self._problem.condensed.slope(variable, amplitudes) - load_change
        return to_real(self._orders[:, None] * turned)

    def motion(self, coefficients: Array, frequency: float) -> Array:
        """Return the coefficients of the full motion u [m], shape (2H + 1, dofs)."""
        variable = self._orders * frequency
        motion = to_real(
            self._problem.condensed.motion(
                variable, to_complex(coefficients), self._force
            )
        )
        motion[0] += self._problem.position
        return motion
