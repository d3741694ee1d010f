"""The residual of a nonlinear mode and its Jacobian (theory, eqs. 27–31)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.fourier import FourierBasis, derivative, to_complex, to_real
from hbm.free_motion import FreeMotion
from hbm.jacobian import assemble, terms
from hbm.linearisation import Linearisation
from hbm.relative import RelativeProblem
from microslip_mechanics.arrays import Array, ComplexArray

STRIDE = 0.01
"""change of the pole, over that of the linear mode, that counts as one unit of arc"""
FARTHEST = 60.0
"""of log a, either way, that a trial may go"""
FAINT = 1e-2
"""relative motion over the amplitude, below which its changes count less"""


@dataclass(frozen=True, slots=True)
class Reference:
    """What a mode is measured by: the linear one from which it grows."""

    pole: complex
    """s [rad/s]"""
    row: ComplexArray
    """linear form whose value is the amplitude, shape (dofs,)"""
    stiffness: float
    """modal stiffness |s|²φᴴMφ [N/m]"""


@dataclass(frozen=True, slots=True)
class ModalParts:
    """What the components of a point mean."""

    shape: Array
    """coefficients of (y − rest)/amplitude, shape (2H + 1, rank)"""
    modal: ComplexArray
    """η over the amplitude, shape (count,)"""
    pole: complex
    """s [rad/s]"""
    amplitude: float
    """[m]"""


class ModalBalance:
    """Residual of a nonlinear mode with a fixed number of harmonics and samples.

    A point is the flat array of coefficients, shape (2H + 1, rank + count + 1),
    followed by log a. The columns are (y − rest)/a, then η/a and s over the modulus of
    the linear pole, which have order 1 alone. It may carry more harmonics than are
    solved for: those are ignored. Residuals are over a times the modal stiffness.
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
        self.width = self.rank + free.count + 1
        self._speed = abs(reference.pole)
        self._active, self._terms = active, terms(active)
        self._places = np.full(active.shape, -1)
        self._places[active] = np.arange(np.count_nonzero(active))
        self._wanted = np.vstack([active[:1], active[1::2]])
        self._contact = problem.contact(fourier)
        self._orders = np.arange(fourier.harmonics + 1)
        wide = np.arange(fourier.coefficients * self.width).reshape(-1, self.width)
        self._inner = wide[:, : self.rank][active]
        self._outer = wide[1:3, self.rank :].ravel()
        self._still = np.zeros(active.shape)
        self._still[0] = problem.rest
        self._held = self._contact(self._still, self._speed)

    def point(self, parts: ModalParts, size: int) -> Array:
        """Return the point of some parts, with ``size`` components."""
        point = np.zeros(size)
        table = point[:-1].reshape(-1, self.width)
        table[: len(parts.shape), : self.rank] = parts.shape
        pole = parts.pole / self._speed
        table[1:3, self.rank :] = _pair(np.append(parts.modal, pole))
        point[-1] = math.log(parts.amplitude)
        return point

    def parts(self, point: Array) -> ModalParts:
        """Return what a point means."""
        table = point[:-1].reshape(-1, self.width)[: self.fourier.coefficients]
        values = table[1, self.rank :] - 1j * table[2, self.rank :]
        return ModalParts(
            np.where(self._active, table[:, : self.rank], 0.0),
            values[:-1],
            complex(values[-1] * self._speed),
            math.exp(min(max(point[-1], -FARTHEST), FARTHEST)),
        )

    def metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc.

        Relative changes of the relative motion and of the amplitude each, and
        :data:`STRIDE` of the pole.
        """
        table = point[:-1].reshape(-1, self.width)
        scale = np.ones_like(table)
        scale[:, : self.rank] = np.linalg.norm(table[1:, : self.rank]) + FAINT
        scale[:, -1] = STRIDE
        return np.append(scale.ravel(), 1.0)

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses between two orders, last call."""
        return self._contact.impulses(above, most)

    def motion(self, point: Array) -> Array:
        """Return the coefficients of the motion about rest [m], (2H + 1, dofs)."""
        parts, condensed = self.parts(point), self.problem.condensed
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
        parts = self.parts(point)
        amplitudes = to_complex(parts.shape)
        first = self._first(parts.pole, amplitudes[1], parts.modal)
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
        whole[self._outer] = _pair(first.imbalance).ravel()
        return whole, _State(parts, first, stiffness, by_pole, reaction)

    def __call__(self, point: Array) -> tuple[Array, Linearisation]:
        """Return the residual, (size − 1,), and what solves with its Jacobian."""
        whole, state = self._evaluated(point)
        structure = self._assembled(None, state.stiffness)
        contact, by_pole, by_logarithm = self._contacts(state)
        turned = state.by_pole
        by_pole[0] += to_real(turned)[self._active]
        by_pole[1] += to_real(-1j * self._orders[:, None] * turned)[self._active]
        right = np.zeros((2, self.free.count + 1, *self._active.shape))
        back = state.first.back.T
        right[0, :-1, 1], right[0, :-1, 2] = back.real, -back.imag
        right[1, :-1, 1], right[1, :-1, 2] = back.imag, back.real
        border = right[:, :, self._active]
        border[:, -1] = self._speed * by_pole
        bottom = np.zeros((2 * self.free.count + 2, *self._active.shape))
        bottom[:, 1:3] = _embedded(state.first.forward).reshape(
            len(bottom), 2, self.rank
        )
        scale = self.reference.stiffness
        jacobian = np.block(
            [
                [
                    (structure + contact) / scale,
                    border.reshape(len(bottom), -1).T / scale,
                ],
                [bottom[:, self._active], _embedded(state.first.corner)],
            ]
        )
        slope = np.append(by_logarithm / scale, np.zeros(len(bottom)))
        places = np.concatenate([self._inner, self._outer])
        return whole, Linearisation(lambda: (jacobian, slope), places, point.size)

    def _first(
        self, pole: complex, relative: ComplexArray, modal: ComplexArray
    ) -> _First:
        """Return order 1 without contact forces, and the excess of the amplitude."""
        rank = self.rank
        left, matrix = self.free.balance(pole, relative, modal)
        value, row = self.free.seen(pole, relative, modal, self.reference.row)
        lower = np.vstack([matrix[rank:] / self._speed, row])
        lower[:, -1] *= self._speed
        return _First(
            left[:rank],
            np.append(left[rank:] / self._speed, value - 1.0),
            matrix[:rank, :rank],
            matrix[:rank, rank:-1],
            matrix[:rank, -1],
            lower[:, :rank],
            lower[:, rank:],
        )

    def _contacts(self, state: _State) -> tuple[Array, Array, Array]:
        """Return what the contacts add to the derivatives of the forces on y, over a.

        By the unknown coefficients of y, by Re s and −Im s, shape (2, unknowns), and by
        log a, shape (unknowns,).
        """
        shape, pole = state.parts.shape, state.parts.pole
        elastic, viscous = self._contact.tangents.spectra(2 * self.fourier.harmonics)
        stiff, damped = self._assembled(elastic), self._assembled(viscous)
        vibration = shape.copy()
        vibration[0] = 0.0
        by_pole = np.array(
            [
                damped @ vibration[self._active],
                -damped @ derivative(shape)[self._active],
            ]
        )
        matrix = stiff + self._rated(damped, pole)
        self._contact.add_remembered(pole.imag, self._places, matrix)
        by_logarithm = matrix @ shape[self._active] - state.reaction[self._active]
        return matrix, by_pole, by_logarithm

    def _assembled(
        self, series: Array | None, stiffness: ComplexArray | None = None
    ) -> Array:
        """Return the product with a periodic matrix, plus a matrix for each order."""
        if stiffness is None:
            stiffness = np.zeros((len(self._orders), self.rank, self.rank), complex)
        none = np.zeros((self.rank, self.rank, 4 * self.fourier.harmonics + 1))
        return assemble(
            none if series is None else series,
            none,
            stiffness.real.copy(),
            stiffness.imag.copy(),
            0.0,
            self._terms,
        )

    def _rated(self, damped: Array, pole: complex) -> Array:
        """Return the derivative by y of what depends on ẏ, given that by ẏ."""
        moving = self._terms.order > 0
        cosine, sine = self._terms.cosine[moving], self._terms.sine[moving]
        speed = pole.imag * self._terms.order[moving]
        result = np.zeros_like(damped)
        result[:, cosine] = pole.real * damped[:, cosine] - speed * damped[:, sine]
        result[:, sine] = pole.real * damped[:, sine] + speed * damped[:, cosine]
        return result

    def _others(self, pole: complex) -> ComplexArray:
        """Return s of each order: the mean is at rest, all others decay alike.

        Order 1, which may lie on a pole of the stuck structure, is treated apart.
        """
        variable = pole.real + 1j * pole.imag * self._orders
        variable[:2] = 0.0
        return variable


@dataclass(frozen=True, slots=True)
class _First:
    """Order 1 without contact forces."""

    left: ComplexArray
    """forces on y, shape (rank,)"""
    imbalance: ComplexArray
    """of η and of the amplitude, shape (count + 1,)"""
    stiffness: ComplexArray
    """forces by y, shape (rank, rank)"""
    back: ComplexArray
    """forces by η, shape (rank, count)"""
    by_pole: ComplexArray
    """forces by s, shape (rank,)"""
    forward: ComplexArray
    """imbalance by y, shape (count + 1, rank)"""
    corner: ComplexArray
    """imbalance by η and s, shape (count + 1, count + 1)"""


@dataclass(frozen=True, slots=True)
class _State:
    """What led to a residual."""

    parts: ModalParts
    first: _First
    stiffness: ComplexArray
    """of the structure, order by order, shape (H + 1, rank, rank)"""
    by_pole: ComplexArray
    """forces of the structure by s of each order, shape (H + 1, rank)"""
    reaction: Array
    """change of the contact forces from rest, over a, shape (2H + 1, rank)"""


def _pair(values: ComplexArray) -> Array:
    """Return real parts and negative imaginary parts, as rows."""
    return np.stack([values.real, -values.imag])


def _embedded(matrix: ComplexArray) -> Array:
    """Return the matrix that acts on such pairs as ``matrix`` does on the values."""
    return np.block([[matrix.real, matrix.imag], [-matrix.imag, matrix.real]])
