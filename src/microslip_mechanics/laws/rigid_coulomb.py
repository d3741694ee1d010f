"""Coulomb friction that neither creeps nor yields before it slides."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import RIGID
from microslip_mechanics.laws.normal_load import NormalLoad
from microslip_mechanics.laws.row import Row
from microslip_mechanics.quantity import quantity


@dataclass(frozen=True, kw_only=True)
class RigidCoulomb(NormalLoad):
    """T = µN v/|v| while v ≠ 0; |T| ≤ µN, what sticking asks for, while v = 0.

    Two tangents slide together (theory, eq. 9b). A contact that never slides carries no
    mean force: this fixes where it sticks.
    """

    mu: float = quantity(lowest=0.0)
    """µ"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        self.check("rigid-coulomb")

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return the one row."""
        return self.contact(given, friction=RIGID, dynamic=self.mu)
