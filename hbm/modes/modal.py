"""The residual of a nonlinear mode and its Jacobian (theory, eqs. 27–31)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.balance.answers import answers
from hbm.balance.linearisation import Linearisation
from hbm.balance.relative import RelativeProblem
from hbm.forces.fourier import FourierBasis, to_complex, to_real
from hbm.modes.first_order import FirstOrder, first_order
from hbm.modes.free_motion import FreeMotion
from hbm.modes.modal_parts import ModalParts, Reference
from hbm.modes.modal_tangents import ModalTangents
from hbm.modes.modal_unknowns import ModalUnknowns, pair
from microslip_mechanics.arrays import Array, ComplexArray


class ModalBalance:
    """Residual of a nonlinear mode with a fixed number of harmonics and samples.

    Points are those of :class:`~hbm.modes.modal_unknowns.ModalUnknowns`. Residuals are
    over the amplitude times the modal stiffness.
    """

    def __init__(
        self,
        problem: RelativeProblem,
        free: FreeMotion,
        reference: Reference,
        fourier: FourierBasis,
        active: NDArray[np.bool_],
    ) -> None:
        """Plan; ``active`` coefficients of y, (2H + 1, rank), are sought."""
        self.problem, self.free, self.reference = problem, free, reference
        self.fourier, self.rank = fourier, problem.rank
        self.unknowns = ModalUnknowns(active, free.count, reference.pole)
        self._speed = abs(reference.pole)
        self._active = active
        self._wanted = np.vstack([active[:1], active[1::2]])
        self._contact = problem.contact(fourier)
        self._tangents = ModalTangents(self._contact, active)
        self._orders = np.arange(fourier.harmonics + 1)
        self._inner, self._outer = self.unknowns.places
        self._still = np.zeros(active.shape)
        self._still[0] = problem.rest
        self._held = self._contact(self._still, self._speed)

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses between two orders, last call."""
        return self._contact.impulses(above, most)

    def answer(self, point: Array, residual: Array, above: int) -> Array:
        """Return the step with which orders above one answer the residual there.

        That is the last one made.
        """
        parts, beyond = self.unknowns.parts(point), slice(above + 1, None)
        variable, wanted = self._others(parts.pole)[beyond], self._wanted[beyond]
        missing = residual.reshape(-1, self.unknowns.width)[:, : self.rank]
        step = np.zeros((len(self._orders), self.rank), complex)
        step[beyond] = answers(
            self.problem.condensed.dynamic_stiffness(variable, wanted),
            self._contact.small_tangents(self.fourier.harmonics),
            variable,
            wanted,
            self.reference.stiffness * to_complex(missing)[beyond],
        )
        whole = np.zeros(point.size)
        whole[:-1].reshape(-1, self.unknowns.width)[:, : self.rank] = to_real(step)
        return whole

    def motion(self, point: Array) -> Array:
        """Return the coefficients of the motion about rest [m], (2H + 1, dofs)."""
        parts, condensed = self.unknowns.parts(point), self.problem.condensed
        amplitudes = to_complex(parts.shape)
        none = np.zeros((len(amplitudes), len(condensed.static)), complex)
        moved = condensed.motion(self._others(parts.pole), amplitudes, none)
        moved[1] = self.free.motion(parts.pole, amplitudes[1], parts.modal)
        return parts.amplitude * to_real(moved)

    def residual(self, point: Array) -> Array:
        """Return the residual, (size − 1,)."""
        return self._evaluated(point)[0]

    def _evaluated(self, point: Array) -> tuple[Array, _State]:
        """Return the residual, and what led to it."""
        parts = self.unknowns.parts(point)
        amplitudes = to_complex(parts.shape)
        first = first_order(self.free, self.reference, parts)
        condensed, variable = self.problem.condensed, self._others(parts.pole)
        stiffness = condensed.dynamic_stiffness(variable, self._wanted)
        stiffness[0] += self.problem.gauge
        stiffness[1] = first.stiffness
        left = (stiffness @ amplitudes[..., None])[..., 0]
        by_pole = condensed.slope(variable, amplitudes)
        left[1], by_pole[0], by_pole[1] = first.left, 0.0, first.by_pole
        # A trial may go so far that forces overflow: the corrector turns back then.
        with np.errstate(over="ignore", invalid="ignore"):
            force = self._contact(
                self._still + parts.amplitude * parts.shape,
                parts.pole.imag,
                -parts.pole.real,
            )
        reaction = (force - self._held) / parts.amplitude
        whole = np.zeros(point.size - 1)
        balance = to_real(left) + reaction
        whole[self._inner] = balance[self._active] / self.reference.stiffness
        whole[self._outer] = pair(first.imbalance).ravel()
        return whole, _State(parts, first, stiffness, by_pole, reaction)

    def __call__(self, point: Array) -> tuple[Array, Linearisation]:
        """Return the residual, (size − 1,), and what solves with its Jacobian."""
        whole, state = self._evaluated(point)
        calls = self._contact.calls

        def made() -> tuple[Array, Array]:
            if self._contact.calls != calls:
                self._evaluated(point)  # other tangents lie in the buffers
            return self._derivatives(state)

        places = np.concatenate([self._inner, self._outer])
        return whole, Linearisation(made, places, point.size)

    def _derivatives(self, state: _State) -> tuple[Array, Array]:
        """Return those of the residual by the unknowns, and by log a."""
        parts, active = state.parts, self._active
        inner = self._tangents(parts, state.stiffness)
        amplitudes = to_complex(parts.shape)
        structure = (state.stiffness @ amplitudes[..., None])[..., 0]
        by_logarithm = (
            inner @ parts.shape[active] - (to_real(structure) + state.reaction)[active]
        )
        by_pole, turned = self._tangents.by_pole(parts), state.by_pole
        by_pole[0] += to_real(turned)[active]
        by_pole[1] += to_real(-1j * self._orders[:, None] * turned)[active]
        border = state.first.border(active)
        border[:, -1] = self._speed * by_pole
        bottom, corner = state.first.bottom(active), state.first.turning()
        scale = self.reference.stiffness
        jacobian = np.block(
            [
                [inner / scale, border.reshape(len(bottom), -1).T / scale],
                [bottom, corner],
            ]
        )
        return jacobian, np.append(by_logarithm / scale, np.zeros(len(bottom)))

    def _others(self, pole: complex) -> ComplexArray:
        """Return s of each order: the mean is at rest, all others decay alike.

        Order 1, which may lie on a pole of the stuck structure, is treated apart.
        """
        variable = pole.real + 1j * pole.imag * self._orders
        variable[:2] = 0.0
        return variable


@dataclass(frozen=True, slots=True)
class _State:
    """What led to a residual."""

    parts: ModalParts
    first: FirstOrder
    stiffness: ComplexArray
    """of the structure, order by order, shape (H + 1, rank, rank)"""
    by_pole: ComplexArray
    """forces of the structure by s of each order, shape (H + 1, rank)"""
    reaction: Array
    """change of the contact forces from rest, over a, shape (2H + 1, rank)"""
