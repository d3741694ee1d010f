"""Elastic dry friction in one or two tangents, with a variable normal load."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import ELASTIC
from microslip_mechanics.laws.normal_load import NormalLoad
from microslip_mechanics.laws.row import Row
from microslip_mechanics.quantity import quantity


@dataclass(frozen=True, kw_only=True)
class ElasticFriction(NormalLoad):
    """dT = k_t dw_t while |T| < µN, else T = µN along the sliding; T = 0 in separation.

    Two tangents slide together (Yang and Menq, 1998), to second order in a step where
    their direction turns (theory, eq. 10a).
    """

    stiffness: float = quantity("N/m", positive=True)
    """k_t [N/m], alike in both tangents"""
    mu: float = quantity(lowest=0.0)
    """µ"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        self.check("elastic-friction")

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the one row."""
        return self.contact(
            given, friction=ELASTIC, tangential=self.stiffness, dynamic=self.mu
        )
