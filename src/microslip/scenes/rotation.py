"""Table [rotation]: the axes in which a structure of beams moves turn steadily."""

from __future__ import annotations

from dataclasses import dataclass

from microslip.scenes.quantity import quantity


@dataclass(frozen=True, slots=True)
class SteadyRotation:
    """Speed and axis of rotation."""

    speed: float = quantity("rad/s")
    axis: tuple[float, ...] = quantity()
    """direction, of any length"""
    centre: tuple[float, ...] = quantity("m", default=(0.0, 0.0, 0.0))
    """a point of the axis"""

    def __post_init__(self) -> None:
        """Check that there is an axis."""
        for name in ("axis", "centre"):
            count = len(getattr(self, name))
            if count != 3:
                raise ValueError(
                    f"{name} of rotation has {count} number{'s' * (count != 1)}: give "
                    "three, along x, y and z"
                )
        if not any(self.axis):
            raise ValueError("axis of rotation is zero: give a direction")
