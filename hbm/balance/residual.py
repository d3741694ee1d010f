"""The residual R(y, ω) of harmonic balance and its Jacobian (theory, eqs. 17–19)."""

from __future__ import annotations

import copy
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from hbm.balance.answers import answers
from hbm.balance.iterated import Parts
from hbm.balance.jacobian import jacobian, terms
from hbm.balance.linear_balance import LinearBalance
from hbm.balance.linearisation import Linearisation
from hbm.balance.low_orders import RECALLED, USUAL, LowOrders
from hbm.balance.relative import RelativeProblem
from hbm.forces.contact_cycle import ContactCycle
from hbm.forces.fourier import FourierBasis, to_complex, to_real
from hbm.forces.marched import marched
from microslip_mechanics.arrays import Array


class HarmonicBalance:
    """Residual of a problem with a fixed number of harmonics and samples.

    A point is the flat array of the coefficients of y, shape (2H + 1, rank), followed
    by the excitation frequency [rad/s]. It may carry more harmonics than are solved
    for: those are ignored, and their residual is zero.
    """

    def __init__(
        self,
        problem: RelativeProblem,
        fourier: FourierBasis,
        active: NDArray[np.bool_] | None = None,
    ) -> None:
        """Plan for ``problem``; ``active`` coefficients, (2H + 1, rank), are sought.

        The others stay at rest by symmetry; all are active if left out.
        """
        self.fourier, self.rank = fourier, problem.rank
        shape = (fourier.coefficients, self.rank)
        problem = problem.smoothed(fourier.threshold)
        self._active = np.ones(shape, dtype=bool) if active is None else active
        self.contact = problem.contact(fourier)
        self._wanted = np.vstack([self._active[:1], self._active[1::2]])
        self._take(problem)
        self._terms = terms(self._active)
        remembers = bool(marched(problem.points).any())
        split = RECALLED if remembers else USUAL
        iterates = LowOrders.serve(self._active, fourier.samples, split)
        if remembers and iterates:
            from hbm.forces.remembered import fits

            iterates = fits(problem.points, problem.basis, fourier)
        self._separable = self.rank if remembers else 0
        self._low = LowOrders(self._active, split) if iterates else None

    def with_problem(self, problem: RelativeProblem) -> HarmonicBalance:
        """Return the same for other contacts and loads in the same coordinates.

        Both share the buffers of the contacts, if they see the same motion.
        """
        other = copy.copy(self)
        problem = problem.smoothed(self.fourier.threshold)
        if np.array_equal(problem.basis, self.problem.basis):
            other.contact = self.contact.with_points(
                problem.points, problem.offset, problem.floating
            )
        else:
            other.contact = problem.contact(self.fourier)
        other._take(problem)
        return other

    def _take(self, problem: RelativeProblem) -> None:
        """Take over what one problem brings."""
        self.problem = problem
        self._still = np.zeros(self._active.shape)
        self._still[0] = problem.rest
        self._linear = LinearBalance(problem, self._wanted)

    def __call__(self, point: Array) -> tuple[Array, Linearisation]:
        """Return the residual [N], (size − 1,), and what solves with its Jacobian.

        Derivatives are taken by the active coefficients and by the frequency.
        """
        residual = self.residual(point)
        calls, frequency, low = self.contact.calls, float(point[-1]), self._low

        def slope() -> Array:
            if self.contact.calls != calls:
                self.residual(point)  # other tangents lie in the buffers
            return self._slope(point)

        def made() -> tuple[Array, Array]:
            by_last = slope()
            held = self._linear.held(frequency)
            return jacobian(self.contact, held, frequency, self._terms), by_last

        def divided(low: LowOrders) -> Parts:
            by_last, held = slope(), self._linear.held(frequency)
            return low.parts(self.contact, held, frequency, by_last)

        parts = None if low is None else partial(divided, low)
        return residual, Linearisation(
            made, self._terms.unknowns, point.size, parts, self._separable
        )

    def _slope(self, point: Array) -> Array:
        """Return ∂R/∂ω of the unknowns where the contacts were called."""
        coefficients, frequency = self.split(point)
        change = self._linear.slope(coefficients, frequency)
        whole = change + self.contact.by_frequency()
        slope: Array = whole.ravel()[self._terms.unknowns]
        return slope

    def residual(self, point: Array) -> Array:
        """Return the residual [N], (size − 1,)."""
        coefficients, frequency = self.split(point)
        stiffness, load, _ = self._linear.at(frequency)
        amplitudes = to_complex(coefficients)[..., None]
        force = self.contact(coefficients, frequency)
        residual = to_real((stiffness @ amplitudes)[..., 0] - load) + force
        residual[0] += self._pull(coefficients)
        whole = np.zeros(point.size - 1)
        whole[: residual.size] = np.where(self._active, residual, 0.0).ravel()
        return whole

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses between two orders, last call."""
        return self.contact.impulses(above, most)

    def answer(self, point: Array, residual: Array, above: int) -> Array:
        """Return the step with which orders above one answer the residual there.

        That is the last one made.
        """
        beyond, frequency = slice(above + 1, None), float(point[-1])
        shape = (self.fourier.coefficients, self.rank)
        step, orders = np.zeros(shape, complex)[::2], np.arange(shape[0] // 2 + 1)
        step[beyond] = answers(
            self._linear.at(frequency)[0][beyond],
            self.contact.small_tangents(self.fourier.harmonics),
            1j * frequency * orders[beyond],
            self._wanted[beyond],
            to_complex(residual.reshape(shape))[beyond],
        )
        return np.append(to_real(step).ravel(), 0.0)

    def at_frequency(self, point: Array) -> tuple[HarmonicBalance, Array]:
        """Return itself and the point, whose last component is the frequency."""
        return self, point

    def point(self, coefficients: Array, frequency: float) -> Array:
        """Return the point of relative coefficients, shape (≤ 2H + 1, rank)."""
        point = np.zeros(self.fourier.coefficients * self.rank + 1)
        count = min(coefficients.size, point.size - 1)
        point[:count] = coefficients.ravel()[:count]
        point[-1] = frequency
        return point

    def split(self, point: Array) -> tuple[Array, float]:
        """Return the coefficients of y, shape (2H + 1, rank), and the frequency."""
        shape = (self.fourier.coefficients, self.rank)
        solved = point[: shape[0] * shape[1]].reshape(shape)
        return np.where(self._active, solved, self._still), float(point[-1])

    def motion(self, point: Array) -> Array:
        """Return the coefficients of the full motion u [m], shape (2H + 1, dofs)."""
        coefficients, frequency = self.split(point)
        return self._linear.motion(coefficients, frequency)

    def cycle(self, point: Array) -> ContactCycle:
        """Return what the contacts do over one period."""
        coefficients, frequency = self.split(point)
        cycle, tractions = (
            self.contact.cycle(coefficients, frequency),
            self.problem.tractions,
        )
        if tractions is None:
            return cycle
        rigid = tractions.work(to_complex(coefficients), frequency)
        return replace(cycle, friction=cycle.friction + rigid)

    def drift_force(self, point: Array) -> float:
        """Return the mean force [N] by which only the gauge of a free body is held."""
        coefficients, _ = self.split(point)
        return float(np.abs(self._pull(coefficients)).max(initial=0.0))

    def _pull(self, coefficients: Array) -> Array:
        """Return the force of the gauge [N], shape (rank,)."""
        force: Array = self.problem.gauge @ (coefficients[0] - self.problem.rest)
        return force
