"""What steady rotation adds to one beam element or one rigid body."""

from __future__ import annotations

from typing import NamedTuple

from microslip_mechanics.arrays import Array


class RotatingPart(NamedTuple):
    """Terms of M ü + (C + G) u̇ + (K + stiffening + softening) u = load."""

    load: Array
    """centrifugal load [N, N m], shape (motions,)"""
    softening: Array
    """change of that load with the motion, symmetric, shape (motions, motions)"""
    coriolis: Array
    """G, skew-symmetric [N s/m], shape (motions, motions)"""

    def turned(self, turn: Array) -> RotatingPart:
        """Return the terms in other coordinates; ``turn`` maps these from those."""
        return RotatingPart(
            turn.T @ self.load,
            turn.T @ self.softening @ turn,
            turn.T @ self.coriolis @ turn,
        )
