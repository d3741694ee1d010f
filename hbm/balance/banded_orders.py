"""High orders of a balance as a banded matrix, factored (theory §6.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lapack

from hbm.balance.iterated import UnreachedError
from microslip_mechanics.arrays import Array, ComplexArray


class Band(NamedTuple):
    """Where what couples orders of one difference lies in a banded matrix."""

    difference: int
    """order of the row less that of the column"""
    order: NDArray[np.int64]
    """of the column"""
    row: NDArray[np.int64]
    """coordinates of row and column"""
    column: NDArray[np.int64]
    place: NDArray[np.int64]
    """in the flat array of the band"""


class BandedOrders:
    """Orders from a first one on, in complex amplitudes, without their conjugates.

    Order j of a product of a tangent K(θ) with a motion is that of K's order j − k with
    the motion's order k, and of K's order j + k with the conjugate; the latter are high
    orders of the tangents and left out.
    """

    def __init__(self, wanted: NDArray[np.bool_], first: int, width: int) -> None:
        """Plan for the coordinates that are ``wanted`` in each order from ``first`` on.

        ``wanted`` has shape ``(orders, rank)``; the coupling of two orders is kept up
        to a difference of ``width``.
        """
        self._first, self._wanted = first, wanted
        self._both = wanted.repeat(2, axis=0)
        places = np.cumsum(wanted.ravel()).reshape(wanted.shape) - 1
        self._count = int(wanted.sum())
        most = min(width, len(wanted) - 1)
        pairs = [_pairs(wanted, places, each) for each in range(-most, most + 1)]
        # orders of another parity may have no coordinate
        self._reach = max(
            int(np.abs(each[4] - each[5]).max(initial=0)) for each in pairs
        )
        height = 3 * self._reach + 1
        self._shape = (height, self._count)
        self._bands = [
            Band(
                difference,
                first + order,
                a,
                b,
                (2 * self._reach + row - column) * self._count + column,
            )
            for difference, order, a, b, row, column in pairs
        ]

    def factored(
        self,
        structure: ComplexArray,
        stiffness: Array,
        damping: Array,
        frequency: float,
    ) -> FactoredOrders:
        """Return what solves with them.

        Parameters
        ----------
        structure
            Dynamic stiffness of the orders, shape ``(orders, rank, rank)``.
        stiffness, damping
            Coefficients of the tangents, shape ``(rank, rank, 2 · most + 1)``, of at
            least as many orders as are coupled.
        frequency
            Of the excitation [rad/s].

        Raises
        ------
        UnreachedError
            If the banded matrix has no inverse.
        """
        band = np.zeros(self._shape, complex)
        flat = band.ravel()
        for difference, order, row, column, place in self._bands:
            elastic = _order(stiffness, difference)[row, column]
            viscous = _order(damping, difference)[row, column]
            flat[place] = elastic + 1j * frequency * order * viscous
            if difference == 0:
                flat[place] += structure[order - self._first, row, column]
        factors, pivots, failed = lapack.zgbtrf(
            band, self._reach, self._reach, overwrite_ab=True
        )
        if failed != 0:
            raise UnreachedError
        return FactoredOrders(factors, pivots, self._reach, self._wanted, self._both)


class FactoredOrders(NamedTuple):
    """Factors of high orders."""

    factors: ComplexArray
    pivots: NDArray[np.int32]
    reach: int
    """number of diagonals to each side"""
    wanted: NDArray[np.bool_]
    """shape (orders, rank)"""
    both: NDArray[np.bool_]
    """the same of cosines and sines, shape (2 orders, rank)"""

    def solve(self, forces: Array) -> Array:
        """Return the motion of forces: wanted cosines and sines, (unknowns,) each."""
        table = np.zeros(self.both.shape)
        table[self.both] = forces
        right = (table[::2] - 1j * table[1::2])[self.wanted]
        found, _ = lapack.zgbtrs(
            self.factors, self.reach, self.reach, right, self.pivots
        )
        table[::2][self.wanted], table[1::2][self.wanted] = found.real, -found.imag
        return table[self.both]


def _pairs(
    wanted: NDArray[np.bool_], places: NDArray[np.int64], difference: int
) -> tuple[
    int,
    NDArray[np.int64],
    NDArray[np.int64],
    NDArray[np.int64],
    NDArray[np.int64],
    NDArray[np.int64],
]:
    """Return difference, order of the column, coordinates and places of all couplings.

    Orders count from the first one.
    """
    orders = np.arange(len(wanted))
    orders = orders[(orders + difference >= 0) & (orders + difference < len(wanted))]
    both = wanted[orders + difference][:, :, None] & wanted[orders][:, None, :]
    which, row, column = np.nonzero(both)
    order = orders[which]
    return (
        difference,
        order,
        row,
        column,
        places[order + difference, row],
        places[order, column],
    )


def _order(series: Array, order: int) -> ComplexArray:
    """Return a complex order of tangents, shape (rank, rank)."""
    if order == 0:
        return series[:, :, 0] + 0j
    size, sign = abs(order), np.sign(order)
    value: ComplexArray = 0.5 * (
        series[:, :, 2 * size - 1] - sign * 1j * series[:, :, 2 * size]
    )
    return value
