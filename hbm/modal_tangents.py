"""Derivatives of the forces in a nonlinear mode (theory, eqs. 27–31)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.aft import AlternatingFrequencyTime
from hbm.fourier import derivative
from hbm.jacobian import assemble, terms
from hbm.modal_parts import ModalParts
from microslip_mechanics.arrays import Array, ComplexArray


class ModalTangents:
    """Derivatives of the forces on y, of structure and contacts."""

    def __init__(
        self, contact: AlternatingFrequencyTime, active: NDArray[np.bool_]
    ) -> None:
        """Plan for ``active`` coefficients of y, shape (2H + 1, rank)."""
        self._contact, self._active = contact, active
        self._harmonics, self._terms = len(active) // 2, terms(active)
        self._places = np.full(active.shape, -1)
        self._places[active] = np.arange(np.count_nonzero(active))

    def structure(self, stiffness: ComplexArray) -> Array:
        """Return the derivative by y of the structure's forces, (unknowns, unknowns).

        ``stiffness`` of each order has shape ``(H + 1, rank, rank)``.
        """
        return self._assembled(None, stiffness)

    def contacts(
        self, parts: ModalParts, reaction: Array
    ) -> tuple[Array, Array, Array]:
        """Return what the contacts add to the derivatives of the forces on y, over a.

        By the unknown coefficients of y, by Re s and −Im s, shape (2, unknowns), and by
        log a, shape (unknowns,). ``reaction`` is the change of the contact forces from
        rest, over a, shape (2H + 1, rank).
        """
        shape, pole = parts.shape, parts.pole
        elastic, viscous = self._contact.tangents.spectra(2 * self._harmonics)
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
        touched = self._contact.touched(pole.imag, self._places)
        if touched is not None:
            matrix += touched.matrix
        by_logarithm = matrix @ shape[self._active] - reaction[self._active]
        return matrix, by_pole, by_logarithm

    def _assembled(
        self, series: Array | None, stiffness: ComplexArray | None = None
    ) -> Array:
        """Return the product with a periodic matrix, plus a matrix for each order."""
        rank = self._active.shape[1]
        if stiffness is None:
            stiffness = np.zeros((self._harmonics + 1, rank, rank), complex)
        none = np.zeros((rank, rank, 4 * self._harmonics + 1))
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
