"""Mean motions that nothing but friction holds, and what it carries (theory §6.5)."""

from __future__ import annotations

from dataclasses import dataclass

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Floating:
    """How far a mean motion that only friction holds has moved from rest.

    A slider that never slips is unstressed in the middle of its motion, but for what it
    moved so far: else nothing would balance what slips beside it.
    """

    directions: Array
    """of the contact points, orthonormal, shape (3 points, motions)"""
    rest: Array
    """the points' displacement at rest [m], shape (3 points,)"""
    bent: Array | float = 0.0
    """by how much sliders that never slip are bent besides [m], shape (points, 3)"""

    def lean(self, mean: Array) -> Array:
        """Return by how much sliders are bent in the mean [m], shape (points, 3).

        ``mean`` is the points' mean displacement [m], shape ``(3 points,)``.
        """
        along = self.directions.T @ (mean - self.rest)
        return (self.directions @ along).reshape(-1, 3) + self.bent
