"""Unknowns that move: what a symmetry keeps at zero is not solved for (theory §6)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hbm.jacobian import terms
from hbm.residual import HarmonicBalance
from microslip_mechanics.arrays import Array


class ActiveUnknowns:
    """A harmonic balance restricted to some of its coefficients, the others zero.

    On the rig, motion along z has odd harmonics only and all other motion even ones.
    The restriction is exact as long as :attr:`excluded` stays below the tolerance: then
    the equations that are left out hold all the same.
    """

    def __init__(self, balance: HarmonicBalance, active: NDArray[np.bool_]) -> None:
        """Restrict ``balance`` to the ``active`` coefficients, (2H + 1, rank)."""
        self._balance = balance
        self._terms = terms(active)
        self._columns = np.append(self._terms.unknowns, active.size)
        self._left_out = np.flatnonzero(~active)
        self.excluded = 0.0
        """largest residual of the equations left out, at the last evaluation [N]"""

    def __call__(self, point: Array) -> tuple[Array, Array]:
        """Return residual and Jacobian of the active unknowns."""
        whole = self.expanded(point)
        residual, jacobian = self._balance.evaluated(whole, self._terms)
        self.excluded = float(np.abs(residual[self._left_out]).max(initial=0.0))
        return residual[self._terms.unknowns], jacobian

    def expanded(self, point: Array) -> Array:
        """Return a point of the whole system from an active one."""
        whole = np.zeros(self._columns.size + self._left_out.size)
        whole[self._columns] = point
        return whole

    def restricted(self, point: Array) -> Array:
        """Return an active point from one of the whole system."""
        active: Array = point[self._columns]
        return active


def moving(balance: HarmonicBalance, point: Array) -> NDArray[np.bool_]:
    """Return the coefficients that drive, structure and contacts can set moving.

    Beginning with what moves at ``point``, coefficients are added that the structure
    couples to those which move, or in which the contacts answer a random motion of
    those, from tiny to sliding and lifting off. Mean values always move. Symmetry makes
    the others exactly zero but for rounding.
    """
    coefficients, frequency = balance.split(point)
    active = np.zeros(coefficients.shape, dtype=bool)
    active[0] = True
    active |= _large(coefficients)
    active = _paired(active)
    coupling = _coupling(balance, frequency)
    largest = np.abs(coefficients[1:]).max(initial=1e-12)
    random = np.random.default_rng(0)
    while True:
        grown = active.copy()
        coupled = (coupling & active[1::2, None, :]).any(axis=2)
        grown[1:] |= coupled.repeat(2, axis=0)
        for size in (1e-2, 1.0, 1e2, 1e4):
            motion = size * largest * random.normal(size=active.shape) * active
            motion[0] = coefficients[0]
            grown |= _large(balance.contact(motion, frequency).force)
        grown = _paired(grown)
        if np.array_equal(grown, active):
            return active
        active = grown


def _large(values: Array) -> NDArray[np.bool_]:
    """Return what stands out from rounding."""
    size = np.abs(values)
    large: NDArray[np.bool_] = size > 1e-10 * size.max(initial=0.0)
    return large


def _paired(active: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Activate cosine and sine of an order together."""
    paired = active.copy()
    both = active[1::2] | active[2::2]
    paired[1::2], paired[2::2] = both, both
    return paired


def _coupling(balance: HarmonicBalance, frequency: float) -> NDArray[np.bool_]:
    """Return which coordinates the structure couples, order by order from 1."""
    orders = np.arange(1, balance.fourier.harmonics + 1)
    stiffness, _ = balance.condensed.dynamic_stiffness(1j * frequency * orders)
    size = np.abs(stiffness)
    coupled: NDArray[np.bool_] = size > 1e-10 * size.max(
        (1, 2), keepdims=True, initial=0.0
    )
    return coupled
