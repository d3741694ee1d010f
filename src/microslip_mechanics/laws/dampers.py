"""Dampers of the relative velocity."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import TWO_SIDED, PointLaw
from microslip_mechanics.laws.row import ALONG, Counts, Row, along
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True)
class LinearDamper:
    """F = c ẇ."""

    damping: float = quantity("N s/m", lowest=0.0)
    """c [N s/m]"""

    def __post_init__(self) -> None:
        """Check the number."""
        check_quantities(self, "linear-damper")

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return the one row."""
        return along(PointLaw(normal=TWO_SIDED, damping=self.damping))


@dataclass(frozen=True)
class QuadraticDamper:
    """F = c₂ |ẇ| ẇ, the drag of a fluid."""

    damping: float = quantity("N s^2/m^2", lowest=0.0)
    """c₂ [N s²/m²]"""

    def __post_init__(self) -> None:
        """Check the number."""
        check_quantities(self, "quadratic-damper")

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return the one row."""
        return along(
            PointLaw(normal=TWO_SIDED, damping=self.damping, damping_exponent=1.0)
        )
