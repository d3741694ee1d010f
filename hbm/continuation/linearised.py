"""The derivative of a residual at a point: what solves with it (theory §6.2)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol, TypeAlias

from microslip_mechanics.arrays import Array


class Linearised(Protocol):
    """The derivative of a residual at a point."""

    @property
    def exact(self) -> bool:
        """Whether solutions are exact but for rounding; else tangents err by 1e-4."""

    def solve(self, normal: Array, right: Array) -> Array:
        """Solve [Jacobian; normal] d = right.

        ``normal`` has shape ``(n + 1,)``, ``right`` that or ``(n + 1, several)``.

        Raises
        ------
        SingularError
            If there is no solution.
        """

    def orientation(self, tangent: Array) -> float:
        """Return the sign of the determinant that has the tangent as its border.

        Along a curve it changes at branch points alone. 0 if it is not known.
        """

    def forget(self) -> None:
        """Let go of what takes memory: solving again makes it anew."""


class SingularError(ArithmeticError):
    """The bordered Jacobian has no inverse."""


System: TypeAlias = Callable[[Array], tuple[Array, Linearised]]
"""point (n + 1,) ↦ residual (n,) and what solves with its Jacobian"""
