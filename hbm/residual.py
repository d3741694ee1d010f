"""The residual R(y, ω) of harmonic balance and its Jacobian (theory, eqs. 17–19)."""

from __future__ import annotations

import numpy as np

from hbm.aft import AlternatingFrequencyTime
from hbm.condensation import CondensedStructure, condense
from hbm.fourier import FourierBasis, derivative, to_complex, to_real
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import StaticState


class HarmonicBalance:
    """Residual of a problem in the relative coordinates of its contacts.

    A point is the flat array of the coefficients of y, shape (2H + 1, rank), followed
    by the excitation frequency [rad/s].
    """

    def __init__(
        self, problem: Problem, rest: StaticState, fourier: FourierBasis
    ) -> None:
        """Condense ``problem`` and plan transforms; ``rest`` is its equilibrium."""
        basis, self.selection = problem.interface.relative_motion()
        self.fourier, self.rank = fourier, basis.shape[1]
        self.condensed: CondensedStructure = condense(problem, self.selection)
        self.contact = AlternatingFrequencyTime(
            problem.interface.points, basis, fourier
        )
        self._force = np.zeros((fourier.harmonics + 1, problem.structure.dofs), complex)
        self._force[0], self._force[1] = problem.preload, -1j * problem.drive
        self._gauge = self._free_positions(rest)

    def __call__(self, point: Array) -> tuple[Array, Array]:
        """Return the residual [N] and its Jacobian, (unknowns, unknowns + 1)."""
        coefficients, frequency = self.split(point)
        variable = self._variable(frequency)
        stiffness, stiffness_change = self.condensed.dynamic_stiffness(variable)
        load, load_change = self.condensed.load(variable, self._force)
        orders = 1j * np.arange(self.fourier.harmonics + 1)[:, None]
        amplitudes = to_complex(coefficients)[..., None]
        linear = (stiffness @ amplitudes)[..., 0] - load
        change = orders * ((stiffness_change @ amplitudes)[..., 0] - load_change)
        contact = self.contact(coefficients, frequency)
        residual = to_real(linear) + contact.force
        residual[0] += self._gauge @ coefficients[0]
        return residual.ravel(), self._jacobian(
            stiffness, contact.by_displacement, contact.by_velocity,
            to_real(change), coefficients, frequency,
        )  # fmt: skip

    def point(self, motion: Array, frequency: float) -> Array:
        """Return the point of a motion u with coefficients (2H + 1, dofs)."""
        return np.append(motion @ self.selection.T, frequency)

    def split(self, point: Array) -> tuple[Array, float]:
        """Return the coefficients of y, shape (2H + 1, rank), and the frequency."""
        return point[:-1].reshape(-1, self.rank), float(point[-1])

    def motion(self, point: Array) -> Array:
        """Return the coefficients of the full motion u [m], shape (2H + 1, dofs)."""
        coefficients, frequency = self.split(point)
        amplitudes = to_complex(coefficients)
        variable = self._variable(frequency)
        return to_real(self.condensed.motion(variable, amplitudes, self._force))

    def drift_force(self, point: Array) -> float:
        """Return the mean force [N] by which only the gauge of a free body is held."""
        coefficients, _ = self.split(point)
        return float(np.abs(self._gauge @ coefficients[0]).max(initial=0.0))

    def _variable(self, frequency: float) -> ComplexArray:
        return 1j * frequency * np.arange(self.fourier.harmonics + 1)

    def _jacobian(
        self,
        stiffness: ComplexArray,
        by_displacement: Array,
        by_velocity: Array,
        change: Array,
        coefficients: Array,
        frequency: float,
    ) -> Array:
        size, rank = coefficients.shape
        jacobian = np.empty((size * rank, size * rank + 1))
        square = by_displacement.copy()
        orders = np.arange(1, self.fourier.harmonics + 1)[:, None, None]
        cosine, sine = by_velocity[:, :, 1::2], by_velocity[:, :, 2::2]
        square[:, :, 1::2] -= frequency * orders[:, :, 0] * sine
        square[:, :, 2::2] += frequency * orders[:, :, 0] * cosine
        square[0, :, 0] += stiffness[0].real + self._gauge
        odd, even = np.arange(1, size, 2), np.arange(2, size, 2)
        square[odd, :, odd] += stiffness[1:].real
        square[even, :, even] += stiffness[1:].real
        square[odd, :, even] += stiffness[1:].imag
        square[even, :, odd] -= stiffness[1:].imag
        jacobian[:, :-1] = square.reshape(size * rank, size * rank)
        slope = by_velocity.reshape(size * rank, -1) @ derivative(coefficients).ravel()
        jacobian[:, -1] = change.ravel() + slope
        return jacobian

    def _free_positions(self, rest: StaticState) -> Array:
        """Return a stiffness along mean motions that nothing holds, else zero.

        Without a rope, say, the mean position of the friction element is arbitrary;
        pinning it changes no force as long as :meth:`drift_force` vanishes.
        """
        start = np.zeros((self.fourier.coefficients, self.rank))
        start[0] = self.selection @ rest.displacement
        tangent = self.contact(start, 1.0).by_displacement[0, :, 0]
        held = self.condensed.stiffness + tangent
        sizes, directions = np.linalg.eigh((held + held.T) / 2.0)
        if self.rank == 0:
            return held
        loose = directions[:, sizes < 1e-11 * sizes[-1]]
        gauge: Array = sizes[-1] * 1e-6 * loose @ loose.T
        return gauge
