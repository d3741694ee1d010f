"""Arc length along a curve: its unit, its tangents and the planes across (theory §6.2).

Vectors have shape (n + 1,), the parameter last.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hbm.continuation.correction import Correction
from hbm.continuation.linearised import Linearised
from microslip_mechanics.arrays import Array

Metric = Callable[[Array], Array]
"""point ↦ the change of each component that counts as one unit of arc, the scale"""


def tangent(linearised: Linearised, direction: Array, scale: Array) -> Array:
    """Return the unit tangent (in the metric) that goes on along ``direction``.

    Raises
    ------
    SingularError
        If the curve does not go on along it.
    """
    right = np.zeros(direction.size)
    right[-1] = 1.0
    along = linearised.solve(direction / scale**2, right)
    unit: Array = along / float(np.linalg.norm(along / scale))
    return unit


def turn(candidate: Correction, direction: Array, scale: Array) -> float:
    """Return the cosine between the tangent at a point and the one before it."""
    return float((candidate.along / scale) @ (direction / scale))


def distance(one: Array, other: Array, scale: Array) -> float:
    """Return the distance of two points in the metric."""
    return float(np.linalg.norm((one - other) / scale))


def plane_across(direction: Array, scale: Array) -> Array:
    """Return the normal of planes across a direction; its largest component is one."""
    normal = direction / scale**2
    unit: Array = normal / np.abs(normal).max()
    return unit


def upright(point: Array) -> Array:
    """Return the normal of the plane in which the parameter is that of ``point``."""
    normal = np.zeros_like(point)
    normal[-1] = 1.0
    return normal
