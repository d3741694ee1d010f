"""Springs that only push: with a gap or pressed at rest, and Hunt and Crossley's."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import PointLaw
from microslip_mechanics.laws.row import ALONG, Counts, Row, along
from microslip_mechanics.quantity import check_quantities, quantity


def touching(
    name: str, stiffness: float, exponent: float, gap: float | None, preload: float
) -> float:
    """Return the displacement [m] at which a contact begins; negative if pressed.

    Raises
    ------
    ValueError
        If there are a gap and a preload, or a gap of the wrong sign.
    """
    if gap is not None and gap < 0.0:
        raise ValueError(
            f"{name}: gap = {gap:g} m is negative: a contact that is pressed at rest "
            "has no gap, give its preload [N] instead; one that closes in the other "
            "direction needs its two ends exchanged"
        )
    if gap and preload:
        raise ValueError(
            f"{name}: gap = {gap:g} m and preload = {preload:g} N: an open contact "
            "carries no load, give one of the two"
        )
    if preload:
        return -float((preload / stiffness) ** (1.0 / exponent))
    return gap or 0.0


@dataclass(frozen=True)
class UnilateralSpring:
    """F = k (w − g)^p + c ẇ while w > g, else 0; it never pulls.

    w is the displacement of the first end towards the second: contact closes as it
    grows.
    """

    stiffness: float = quantity("N/m^p", positive=True)
    """k [N/m^p]"""
    gap: float | None = quantity("m", optional=True, told=("at least 0", "0"))
    """g ≥ 0 [m]; 0 if left out"""
    preload: float = quantity("N", lowest=0.0, default=0.0)
    """contact force while w = 0 [N], in place of a gap"""
    exponent: float = quantity(lowest=1.0, highest=10.0, default=1.0)
    """p; 1.5 is Hertz's sphere"""
    damping: float = quantity("N s/m", lowest=0.0, default=0.0)
    """c [N s/m], in contact only"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        check_quantities(self, "unilateral-spring")
        self._touching()

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return the one row."""
        return along(
            PointLaw(
                gap=self._touching(),
                stiffness=self.stiffness,
                exponent=self.exponent,
                damping=self.damping,
                clamped=True,
            )
        )

    def _touching(self) -> float:
        return touching(
            "unilateral-spring", self.stiffness, self.exponent, self.gap, self.preload
        )
