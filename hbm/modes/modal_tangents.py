"""Derivatives of the forces in a nonlinear mode (theory, eqs. 27–31)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.balance.jacobian import assemble, jacobian, terms
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import derivative
from hbm.modes.modal_parts import ModalParts
from microslip_mechanics.arrays import Array, ComplexArray


class ModalTangents:
    """Derivatives of the forces on y, of structure and contacts."""

    def __init__(
        self, contact: AlternatingFrequencyTime, active: NDArray[np.bool_]
    ) -> None:
        """Plan for ``active`` coefficients of y, shape (2H + 1, rank)."""
        self._contact, self._active = contact, active
        self._harmonics, self._terms = len(active) // 2, terms(active)

    def __call__(self, parts: ModalParts, stiffness: ComplexArray) -> Array:
        """Return the derivative of the forces on y by y, (unknowns, unknowns).

        ``stiffness`` of the structure, order by order, has shape
        ``(H + 1, rank, rank)``; contacts are where they were called last.
        """
        pole = parts.pole
        return jacobian(self._contact, stiffness, pole.imag, self._terms, pole.real)

    def by_pole(self, parts: ModalParts) -> Array:
        """Return what the contacts feel of Re s and −Im s, over a, (2, unknowns)."""
        shape, rank = parts.shape, self._active.shape[1]
        _, viscous = self._contact.tangents.spectra(2 * self._harmonics)
        none = np.zeros((self._harmonics + 1, rank, rank))
        damped = assemble(viscous, np.zeros_like(viscous), none, none, 0.0, self._terms)
        vibration = shape.copy()
        vibration[0] = 0.0
        return np.array(
            [
                damped @ vibration[self._active],
                -damped @ derivative(shape)[self._active],
            ]
        )
