"""Which orders of a large balance are factored, others being iterated (theory §6.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.balance.banded_orders import BandedOrders
from hbm.balance.iterated import Parts
from hbm.balance.jacobian import assemble, terms
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import to_complex, to_real
from hbm.forces.touch_factors import touch_factors
from microslip_mechanics.arrays import Array, ComplexArray

LARGE = 1200
"""unknowns from which on iterations cost less than factors of all orders"""


class Split(NamedTuple):
    """How orders are taken apart."""

    many: int
    """unknowns whose factors cost as much as their iterations"""
    least: int
    """harmonics that are factored however many unknowns they have"""
    width: int
    """difference of two of the other orders up to which their coupling is kept"""


USUAL, RECALLED = Split(800, 31, 8), Split(400, 7, 4)
"""the second beside contacts that remember, which jam no motion"""


class LowOrders:
    """Takes a Jacobian apart into low orders and the others."""

    def __init__(self, active: NDArray[np.bool_], split: Split = USUAL) -> None:
        """Plan for ``active`` coefficients, shape (2H + 1, rank)."""
        self._active, harmonics = active, len(active) // 2
        low = max((harmonics - 1) // 2, 1)
        while low > split.least and _count(active, low) > split.many:
            low = max((low - 1) // 2, split.least)
        self._harmonics = low
        self._terms = terms(active[: 2 * low + 1])
        self._unknowns = np.flatnonzero(active)
        self._places = np.where(active, 0, -1)
        self._high = BandedOrders(active[2 * low + 1 :: 2], low + 1, split.width)

    @staticmethod
    def serve(active: NDArray[np.bool_], samples: int, split: Split = USUAL) -> bool:
        """Return whether taking it apart is likely to cost less than all factors."""
        unknowns, rank = np.count_nonzero(active), active.shape[1]
        held = 2 * rank**2 * samples  # tangents, in place of the Jacobian
        large = unknowns > LARGE and len(active) // 2 > 2 * split.least
        return bool(large and held <= unknowns**2)

    def parts(
        self,
        contact: AlternatingFrequencyTime,
        stiffness: ComplexArray,
        frequency: float,
        slope: Array,
    ) -> Parts:
        """Return the parts where the contacts were called last.

        Parameters
        ----------
        contact
            Not rigid.
        stiffness
            Of the structure in each order, shape ``(H + 1, rank, rank)``.
        frequency
            Of the excitation [rad/s].
        slope
            Derivative of the residual by the last component, shape ``(unknowns,)``.
        """
        product, low = contact.tangents.product(), self._harmonics
        tangents = contact.tangents.spectra(2 * low)
        corner = assemble(
            *tangents,
            np.ascontiguousarray(stiffness[: low + 1].real),
            np.ascontiguousarray(stiffness[: low + 1].imag),
            frequency,
            self._terms,
        )
        touched = touch_factors(contact, self._places)
        remembered = contact.remembered()
        if touched is not None:
            corner += touched.up_to(len(corner)).matrix
        if remembered is not None:
            contact.add_remembered(self._terms.places, corner)
            series = remembered.series(2 * low)
            tangents = tangents[0] + series[0], tangents[1] + series[1]
        high = self._high.factored(stiffness[low + 1 :], *tangents, frequency)

        def times(step: Array) -> Array:
            moved = np.zeros(self._active.shape)
            moved.ravel()[self._unknowns] = step
            felt = (stiffness @ to_complex(moved)[..., None])[..., 0]
            changed = to_real(felt) + product(moved, frequency)
            if remembered is not None:
                changed += remembered.product(moved)
            forces: Array = changed.ravel()[self._unknowns]
            return forces if touched is None else forces + touched.product(step)

        return Parts(times, corner, high.solve, slope)


def _count(active: NDArray[np.bool_], harmonics: int) -> int:
    """Return the number of unknowns up to an order."""
    return int(np.count_nonzero(active[: 2 * harmonics + 1]))
