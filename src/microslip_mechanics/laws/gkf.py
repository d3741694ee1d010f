"""General kinetic friction: Coulomb's with Stribeck's fall from rest to sliding."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import GENERAL_KINETIC
from microslip_mechanics.laws.normal_load import NormalLoad
from microslip_mechanics.laws.row import Row
from microslip_mechanics.quantity import quantity


@dataclass(frozen=True, kw_only=True)
class GeneralKineticFriction(NormalLoad):
    """T = N µ(v) min(|v|/V_lim, 1) v/|v| + f v, µ(v) = µd + (µs − µd) e^−(|v|/V_str)^γ.

    f v acts while faces touch, under a constant load always (theory, eq. 10).
    """

    mu_dynamic: float = quantity(lowest=0.0)
    """µd"""
    mu_static: float = quantity(lowest=0.0)
    """µs"""
    stribeck_velocity: float = quantity("m/s", positive=True)
    """V_str [m/s]"""
    stribeck_exponent: float = quantity(positive=True, highest=10.0, default=1.0)
    """γ"""
    threshold_velocity: float = quantity("m/s", positive=True)
    """V_lim [m/s]: below it the contact creeps"""
    viscous: float = quantity("N s/m", lowest=0.0, default=0.0)
    """f [N s/m]"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        self.check("gkf")

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the one row."""
        return self.contact(
            given,
            friction=GENERAL_KINETIC,
            dynamic=self.mu_dynamic,
            static=self.mu_static,
            stribeck=self.stribeck_velocity,
            stribeck_exponent=self.stribeck_exponent,
            threshold=self.threshold_velocity,
            viscous=self.viscous,
        )
