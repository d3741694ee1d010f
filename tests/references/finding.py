"""One number that is known from elsewhere, beside microslip's own."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Finding:
    """A quantity of a system, its known value, and what microslip finds."""

    system: str
    quantity: str
    source: str
    """citation of the known value"""
    known: float
    found: float
    tolerance: float
    """largest relative error that is accepted"""

    @property
    def error(self) -> float:
        """Relative error of what was found."""
        return abs(self.found / self.known - 1.0)

    @property
    def holds(self) -> bool:
        """Whether the error is within the tolerance."""
        return self.error <= self.tolerance
