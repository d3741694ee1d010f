"""Springs whose force is a sum of powers of the displacement."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from microslip_mechanics.arrays import numbers_of
from microslip_mechanics.contact.points import TWO_SIDED, PointLaw
from microslip_mechanics.laws.row import ALONG, BETWEEN, Counts, Row, along
from microslip_mechanics.quantity import check_quantities, quantity


@dataclass(frozen=True)
class PolynomialSpring:
    """F = Σ k_p w^p, with w the relative displacement; it pulls and pushes.

    An odd or fractional power takes the sign of w, an even one is the same both ways.
    """

    coefficients: Mapping[float, float] = quantity("N/m^p")
    """k_p [N/m^p] for each power p ≥ 1, such as {1: 100, 3: 2e6}"""

    def __post_init__(self) -> None:
        """Check powers and coefficients."""
        if not isinstance(self.coefficients, Mapping):
            raise ValueError(  # noqa: TRY004  (one kind of error for one kind of fault)
                f"polynomial-spring: coefficients = {self.coefficients!r}: give one "
                "for each power, such as {3: 2e6}"
            )
        if not self.coefficients:
            raise ValueError(
                "polynomial-spring: coefficients are empty: give some, such as {3: 2e6}"
            )
        for power, value in self.coefficients.items():
            if numbers_of([power, value]).shape != (2,):
                raise ValueError(
                    f"polynomial-spring: coefficient {value!r} of power {power!r}: "
                    "give two finite numbers, such as {3: 2e6}"
                )
            if not 1.0 <= power <= 20.0:
                raise ValueError(
                    f"polynomial-spring: power {power:g}: give 1 to 20; a constant "
                    "force is a preload"
                )

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return one row for each power."""
        return tuple(
            Row(
                PointLaw(normal=TWO_SIDED, stiffness=float(k), exponent=float(power)),
                normal=BETWEEN,
            )
            for power, k in self.coefficients.items()
        )


@dataclass(frozen=True)
class CubicSpring:
    """F = k₃ w³, that of Duffing's oscillator."""

    cubic: float = quantity("N/m^3")
    """k₃ [N/m³]; negative softens"""

    def __post_init__(self) -> None:
        """Check the number."""
        check_quantities(self, "cubic-spring")

    @property
    def takes(self) -> Counts:
        """One direction."""
        return ALONG

    def rows(self, given: dict[str, int]) -> tuple[Row, ...]:  # noqa: ARG002
        """Return the one row."""
        return along(PointLaw(normal=TWO_SIDED, stiffness=self.cubic, exponent=3.0))
