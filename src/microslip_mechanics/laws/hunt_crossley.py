"""Hunt and Crossley's contact: a spring and a damper that grow with penetration."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import PointLaw
from microslip_mechanics.laws.row import ALONG, Counts, Row, along
from microslip_mechanics.laws.unilateral import touching
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True)
class HuntCrossleyContact:
    """F = k δ^p + c δ^q δ̇ with the penetration δ = w − g > 0, else 0.

    Hunt and Crossley, 1975 (theory, eq. 7).
    """

    stiffness: float = quantity("N/m^p", positive=True)
    """k [N/m^p]"""
    exponent: float = quantity(lowest=1.0, highest=10.0, default=1.5)
    """p"""
    damping: float = quantity("N s/m^(q+1)", lowest=0.0, default=0.0)
    """c [N s/m^(q+1)]"""
    damping_exponent: float | None = quantity(
        lowest=0.0,
        highest=10.0,
        optional=True,
        told=("", "as `exponent`"),
    )
    """q; p if left out, as in the source"""
    clamped: bool = quantity(default=True)
    """whether a pulling force, possible at fast separation, is set to zero"""
    gap: float | None = quantity("m", optional=True, told=("at least 0", "0"))
    """g ≥ 0 [m]; 0 if left out"""
    preload: float = quantity("N", lowest=0.0, default=0.0)
    """contact force while w = 0 [N], in place of a gap"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        check_quantities(self, "hunt-crossley")
        self._touching()

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return the one row."""
        power = self.damping_exponent
        return along(
            PointLaw(
                gap=self._touching(),
                stiffness=self.stiffness,
                exponent=self.exponent,
                damping=self.damping,
                damping_exponent=self.exponent if power is None else power,
                clamped=self.clamped,
            )
        )

    def _touching(self) -> float:
        return touching(
            "hunt-crossley", self.stiffness, self.exponent, self.gap, self.preload
        )
