"""Order 1 of a nonlinear mode without contact forces (theory, eqs. 29–31)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.forces.fourier import to_complex
from hbm.modes.free_motion import FreeMotion
from hbm.modes.modal_parts import ModalParts, Reference
from microslip_mechanics.arrays import Array, ComplexArray


@dataclass(frozen=True, slots=True)
class FirstOrder:
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

    def border(self, active: NDArray[np.bool_]) -> Array:
        """Return forces on ``active`` coefficients of y by η; the last row is zero.

        By real parts and negative imaginary parts, (2, count + 1, coefficients).
        """
        right = np.zeros((2, self.back.shape[1] + 1, *active.shape))
        back = self.back.T
        right[0, :-1, 1], right[0, :-1, 2] = back.real, -back.imag
        right[1, :-1, 1], right[1, :-1, 2] = back.imag, back.real
        return right[:, :, active]

    def bottom(self, active: NDArray[np.bool_]) -> Array:
        """Return the imbalance by ``active`` coefficients of y, as pairs.

        Shape (2 (count + 1), coefficients).
        """
        count, rank = self.forward.shape
        bottom = np.zeros((2 * count, *active.shape))
        bottom[:, 1:3] = _embedded(self.forward).reshape(2 * count, 2, rank)
        return bottom[:, active]

    def turning(self) -> Array:
        """Return the imbalance by η and s, as pairs, (2 (count + 1), 2 (count + 1))."""
        return _embedded(self.corner)


def first_order(
    free: FreeMotion, reference: Reference, parts: ModalParts
) -> FirstOrder:
    """Return order 1 without contact forces, and the excess of the amplitude."""
    speed, relative = abs(reference.pole), to_complex(parts.shape)[1]
    rank = relative.size
    left, matrix = free.balance(parts.pole, relative, parts.modal)
    value, row = free.seen(parts.pole, relative, parts.modal, reference.row)
    lower = np.vstack([matrix[rank:] / speed, row])
    lower[:, -1] *= speed
    return FirstOrder(
        left[:rank],
        np.append(left[rank:] / speed, value - 1.0),
        matrix[:rank, :rank],
        matrix[:rank, rank:-1],
        matrix[:rank, -1],
        lower[:, :rank],
        lower[:, rank:],
    )


def _embedded(matrix: ComplexArray) -> Array:
    """Return the matrix that acts on such pairs as ``matrix`` does on the values."""
    return np.block([[matrix.real, matrix.imag], [-matrix.imag, matrix.real]])
