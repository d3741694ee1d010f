"""Quantities of a scene, and the error of a scene that cannot be read or built."""

from __future__ import annotations

from microslip.errors import GivenError
from microslip_mechanics.quantity import UNITS, Quantity, quantity

__all__ = ["UNITS", "Quantity", "SceneError", "quantity"]


class SceneError(GivenError):
    """A scene that cannot be read or built: where, which value, and what to do."""
