"""A plane face that stays closed: its stiffness in translation and in rotation."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.contact.points import TWO_SIDED, PointLaw
from microslip_mechanics.laws.row import Counts, Direction, Row
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True)
class AreaContact:
    """F = K w_n, and M = K b²/12 · θ about an axis in the plane of a face b wide.

    A bed of equal springs over the face, all of them in contact, has these resultants;
    a face that opens at an edge needs points instead, each a unilateral spring.
    ``width`` is b across the axis of the first rotation, ``depth`` across that of the
    second one.
    """

    stiffness: float = quantity("N/m", positive=True)
    """K_tot [N/m] of the whole face, along its normal"""
    width: float = quantity("m", positive=True)
    """b [m] across the axis of the first rotation"""
    depth: float | None = quantity("m", positive=True, optional=True)
    """of the face across the axis of the second rotation [m]"""

    def __post_init__(self) -> None:
        """Check the numbers."""
        check_quantities(self, "area-contact")

    @property
    def takes(self) -> Counts:
        """One normal, and one or two rotations."""
        rotations = 1 if self.depth is None else 2
        return {"normal": (1, 1), "rotations": (rotations, rotations)}

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:
        """Return a row for the normal and one for each rotation."""
        widths = (self.width, self.depth or 0.0)[: given["rotations"]]
        uses: list[tuple[Direction, float]] = [(("normal", 0), self.stiffness)]
        uses += [
            (("rotations", place), self.stiffness * width**2 / 12.0)
            for place, width in enumerate(widths)
        ]
        return tuple(
            Row(PointLaw(normal=TWO_SIDED, stiffness=stiffness), normal=along)
            for along, stiffness in uses
        )
