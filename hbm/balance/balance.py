"""What systems have in common whose points are harmonic balances."""

from __future__ import annotations

from typing import Protocol

from hbm.balance.linearisation import Linearisation
from hbm.balance.refined import Resolved
from hbm.balance.residual import HarmonicBalance
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array


class Balance(Resolved, Protocol):
    """A system whose points are harmonic balances at some frequency."""

    fourier: FourierBasis

    def __call__(self, point: Array) -> tuple[Array, Linearisation]:
        """Return the residual [N], (size − 1,), and what solves with its Jacobian."""

    def at_frequency(self, point: Array) -> tuple[HarmonicBalance, Array]:
        """Return harmonic balance at the point's parameter, and the point for it."""
