"""Coulomb friction, regularised below a threshold velocity."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import COULOMB, TANH
from microslip_mechanics.laws.normal_load import NormalLoad
from microslip_mechanics.laws.row import Row
from microslip_mechanics.quantity import quantity


@dataclass(frozen=True, kw_only=True)
class RegularisedCoulomb(NormalLoad):
    """T = µN s(|v|) v/|v| with s = min(|v|/V_lim, 1), or tanh(|v|/V_lim) if smooth.

    Theory, eqs. (9) and (9a). Where a body sticks for most of the period, and V_lim is
    far below its velocities, rigid-coulomb, which has none, has curves that this lacks.
    """

    mu: float = quantity(lowest=0.0)
    """µ"""
    threshold_velocity: float = quantity("m/s", positive=True)
    """V_lim [m/s]: below it the contact creeps"""
    smooth: bool = quantity(default=False)
    """whether a hyperbolic tangent takes the place of straight lines"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        self.check("coulomb")

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the one row."""
        return self.contact(
            given,
            friction=TANH if self.smooth else COULOMB,
            dynamic=self.mu,
            threshold=self.threshold_velocity,
        )
