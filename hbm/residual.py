"""The residual R(y, ω) of harmonic balance and its Jacobian (theory, eqs. 17–19)."""

from __future__ import annotations

import numpy as np

from hbm.aft import AlternatingFrequencyTime
from hbm.condensation import CondensedStructure, condense
from hbm.fourier import FourierBasis, to_complex, to_real
from hbm.jacobian import Terms, assemble, terms
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
        self._terms = terms(np.ones((fourier.coefficients, self.rank), dtype=bool))
        self._gauge = self._free_positions(rest)

    def __call__(self, point: Array) -> tuple[Array, Array]:
        """Return the residual [N] and its Jacobian, (unknowns, unknowns + 1)."""
        return self.evaluated(point, self._terms)

    def evaluated(self, point: Array, chosen: Terms) -> tuple[Array, Array]:
        """Return the whole residual [N], and its Jacobian for the chosen terms.

        The Jacobian has shape ``(unknowns, unknowns + 1)``; its last column is the
        derivative by frequency.
        """
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
        elastic, viscous = stiffness.real.copy(), stiffness.imag.copy()
        elastic[0] += self._gauge
        jacobian = assemble(contact.tangents, elastic, viscous, frequency, chosen)
        slope = to_real(change) + contact.by_frequency
        jacobian[:, -1] = slope.ravel()[chosen.unknowns]
        return residual.ravel(), jacobian

    def point(self, motion: Array, frequency: float) -> Array:
        """Return the point of a motion u with coefficients (2H + 1, dofs)."""
        return np.append(motion @ self.selection.T, frequency)

    def split(self, point: Array) -> tuple[Array, float]:
        """Return the coefficients of y, shape (2H + 1, rank), and the frequency."""
        shape = (self.fourier.coefficients, self.rank)
        return point[:-1].reshape(shape), float(point[-1])

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

    def _free_positions(self, rest: StaticState) -> Array:
        """Return a stiffness along mean motions that nothing holds, else zero.

        Without a rope, say, the mean position of the friction element is arbitrary;
        pinning it changes no force as long as :meth:`drift_force` vanishes.
        """
        start = np.zeros((self.fourier.coefficients, self.rank))
        start[0] = self.selection @ rest.displacement
        tangent = self.contact(start, 1.0).tangents.stiffness_cosine[:, :, 0]
        held = self.condensed.stiffness + tangent
        sizes, directions = np.linalg.eigh((held + held.T) / 2.0)
        if self.rank == 0:
            return np.zeros((0, 0))
        loose = directions[:, sizes < 1e-11 * sizes[-1]]
        gauge: Array = sizes[-1] * 1e-6 * loose @ loose.T
        return gauge
