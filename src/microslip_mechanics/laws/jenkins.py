"""Jenkins' element: a spring in series with a Coulomb slider."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import ELASTIC, PointLaw
from microslip_mechanics.laws.row import ALONG, BETWEEN, Counts, Row
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True)
class Jenkins:
    """dF = k_t dw while |F| < R, else F = ±R (elastic Coulomb; Jenkins, 1962)."""

    stiffness: float = quantity("N/m", positive=True)
    """k_t [N/m]"""
    limit: float = quantity("N", lowest=0.0)
    """slip limit R = µN [N]"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        check_quantities(self, "jenkins")

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return the one row."""
        return (Row(slider(self.stiffness, self.limit), tangents=(BETWEEN,)),)


def slider(stiffness: float, limit: float) -> PointLaw:
    """Return the row of a slider of k_t [N/m] and slip limit [N]."""
    return PointLaw(
        friction=ELASTIC,
        tangential=stiffness,
        dynamic=1.0,
        constant_load=True,
        load=limit,
    )
