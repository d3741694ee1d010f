"""How much work a search may take before it is given up (theory §6.2)."""

from __future__ import annotations

from hbm.continuation.linearised import Linearised, System
from hbm.errors import ContinuationError
from microslip_mechanics.arrays import Array

UNIT = 31
"""harmonics with which an evaluation counts as one; k times as many count as k²"""


class Effort:
    """Counts evaluations of a residual with its derivative, up to a limit."""

    def __init__(self, most: float | None = None) -> None:
        """Grant ``most`` evaluations; without end if left out."""
        self._most = most
        self.spent = 0.0
        """evaluations so far"""

    def part(self, most: float) -> Effort:
        """Grant some of what is left, and no more."""
        left = most if self._most is None else self._most - self.spent
        return Effort(min(most, left))

    def spend(self, harmonics: int) -> None:
        """Count one evaluation.

        Raises
        ------
        ContinuationError
            If it is one too many.
        """
        if self._most is not None and self.spent >= self._most:
            raise ContinuationError(
                f"the effort granted, {self._most:g} evaluations, is spent: grant more"
            )
        self.spent += max(1.0, (harmonics / UNIT) ** 2)

    def counted(self, system: System, harmonics: int) -> System:
        """Return the system, each call of which is counted."""

        def called(point: Array) -> tuple[Array, Linearised]:
            self.spend(harmonics)
            return system(point)

        return called
