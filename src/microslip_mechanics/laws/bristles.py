"""Friction of bending bristles: Dahl's law, and LuGre's with Stribeck's fall."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import BRISTLE
from microslip_mechanics.laws.normal_load import NormalLoad
from microslip_mechanics.laws.row import Row
from microslip_mechanics.quantity import quantity


@dataclass(frozen=True, kw_only=True)
class Dahl(NormalLoad):
    """dT = k_t (dw − |dw| T/(µN)) (Dahl, 1968; theory, eq. 10b)."""

    stiffness: float = quantity("N/m", positive=True)
    """k_t [N/m] of the bristles"""
    mu: float = quantity(positive=True)
    """µ"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        self.check("dahl")

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the one row."""
        return self.contact(
            given,
            friction=BRISTLE,
            tangential=self.stiffness,
            dynamic=self.mu,
            static=self.mu,
        )


@dataclass(frozen=True, kw_only=True)
class LuGre(NormalLoad):
    """dT = k_t (dw − |dw| T/(N µ(v))) and f v beside it, µ(v) as in GKF.

    Canudas de Wit et al., 1995, without their micro-damping (theory, eq. 10b). f v acts
    while faces touch, under a constant load always.
    """

    stiffness: float = quantity("N/m", positive=True)
    """k_t = σ₀ [N/m] of the bristles"""
    mu_dynamic: float = quantity(positive=True)
    """µd"""
    mu_static: float = quantity(positive=True)
    """µs"""
    stribeck_velocity: float = quantity("m/s", positive=True)
    """V_str [m/s]"""
    stribeck_exponent: float = quantity(positive=True, highest=10.0, default=2.0)
    """γ"""
    viscous: float = quantity("N s/m", lowest=0.0, default=0.0)
    """f = σ₂ [N s/m]"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        self.check("lugre")

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the one row."""
        return self.contact(
            given,
            friction=BRISTLE,
            tangential=self.stiffness,
            dynamic=self.mu_dynamic,
            static=self.mu_static,
            stribeck=self.stribeck_velocity,
            stribeck_exponent=self.stribeck_exponent,
            viscous=self.viscous,
        )
