"""The normal load of a friction contact: a constant, or that of a one-sided spring."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from microslip_mechanics.contact.points import PointLaw
from microslip_mechanics.laws.row import Counts, Direction, Row
from microslip_mechanics.laws.unilateral import touching
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True, kw_only=True)
class NormalLoad:
    """N constant, or N = k_n δ^p + c δ^q δ̇ with the penetration δ = w_n − g > 0.

    Give ``load``, or ``normal_stiffness`` and what belongs to it.
    """

    load: float | None = quantity("N", lowest=0.0, optional=True)
    """constant N [N]; the element then has no normal direction"""
    normal_stiffness: float | None = quantity("N/m^p", positive=True, optional=True)
    """k_n [N/m^p]"""
    normal_exponent: float = quantity(lowest=1.0, highest=10.0, default=1.0)
    """p"""
    normal_damping: float = quantity("N s/m^(q+1)", lowest=0.0, default=0.0)
    """c [N s/m^(q+1)]"""
    normal_damping_exponent: float | None = quantity(
        lowest=0.0,
        highest=10.0,
        optional=True,
        told=("", "as `normal_exponent`"),
    )
    """q; p if left out"""
    gap: float | None = quantity("m", optional=True, told=("at least 0", "0"))
    """g ≥ 0 [m]; 0 if left out"""
    preload: float = quantity("N", lowest=0.0, default=0.0)
    """N while w_n = 0 [N], in place of a gap"""

    def check(self, name: str) -> None:
        """Check the numbers; ``name`` is that of the law."""
        check_quantities(self, name)
        if (self.load is None) == (self.normal_stiffness is None):
            raise ValueError(
                f"{name}: give its load [N] if that is constant, or its "
                "normal_stiffness if not, one of the two"
            )
        if self.load is not None and (self.gap or self.preload or self.normal_damping):
            raise ValueError(
                f"{name}: gap, preload and normal_damping belong to a "
                "normal_stiffness: with a constant load leave them out"
            )
        if self.normal_stiffness is not None:
            touching(
                name,
                self.normal_stiffness,
                self.normal_exponent,
                self.gap,
                self.preload,
            )

    @property
    def takes(self) -> Counts:
        """One or two tangents, and a normal unless the load is constant."""
        tangents = {"tangents": (1, 2)}
        return tangents if self.load is not None else {"normal": (1, 1), **tangents}

    def contact(self, given: dict[str, int], **friction: Any) -> tuple[Row, ...]:  # noqa: ANN401
        """Return the row with some friction, whose fields are those of PointLaw."""
        sliding: tuple[Direction, ...] = tuple(
            ("tangents", place) for place in range(given["tangents"])
        )
        if self.normal_stiffness is None:
            point = PointLaw(constant_load=True, load=self.load or 0.0, **friction)
            return (Row(point, None, sliding),)
        power = self.normal_damping_exponent
        point = PointLaw(
            gap=touching(
                "contact",
                self.normal_stiffness,
                self.normal_exponent,
                self.gap,
                self.preload,
            ),
            stiffness=self.normal_stiffness,
            exponent=self.normal_exponent,
            damping=self.normal_damping,
            damping_exponent=self.normal_exponent if power is None else power,
            clamped=True,
            **friction,
        )
        return (Row(point, ("normal", 0), sliding),)
