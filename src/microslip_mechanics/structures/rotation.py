"""Steady rotation of the axes in which a structure moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class Rotation:
    """Axes that turn at a constant rate about a line.

    A hub of radius R is a centre at the distance R from the blade's root.
    """

    speed: float
    """Ω [rad/s]; its sign is the sense about the axis"""
    axis: Array
    """direction of the line, of any length, shape (3,)"""
    centre: Array
    """a point of the line [m], shape (3,)"""

    def __post_init__(self) -> None:
        """Check that all numbers are finite and that there is an axis."""
        for name in ("axis", "centre"):
            vector = getattr(self, name)
            if np.shape(vector) != (3,) or not np.isfinite(vector).all():
                raise ValueError(f"{name} {vector}: give three finite numbers")
        if not np.isfinite(self.speed):
            raise ValueError(f"speed {self.speed:g} rad/s: give a finite one")
        if not np.linalg.norm(self.axis) > 0.0:
            raise ValueError("axis is zero: give a direction")

    @property
    def spin(self) -> Array:
        """Matrix W of the cross product with Ω [rad/s], shape (3, 3)."""
        direction = np.asarray(self.axis) / np.linalg.norm(self.axis)
        return cross(self.speed * direction)


def cross(vector: Array) -> Array:
    """Return the matrix of the cross product with a vector, shape (3, 3)."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
