"""Which tangents the contacts have, and what they are to the coordinates y (§6.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import tangent_pattern
from microslip_mechanics.contact.points import ContactPoints


def tangent_entries(points: ContactPoints, pruned: bool) -> NDArray[np.int64]:
    """Return (row, column, by velocity) of the tangents: those that can be, or all."""
    rows = []
    for point in range(len(points.load)):
        for kind, pattern in enumerate(tangent_pattern(points, point)):
            for row, column in np.argwhere(pattern | (not pruned)):
                rows.append((3 * point + row, 3 * point + column, kind))
    return np.array(rows, dtype=np.int64).reshape(-1, 3)


def mixing(basis: Array, entries: NDArray[np.int64]) -> Array:
    """Return the map from tangents of the points to those of y, (2 rank², entries)."""
    rank = basis.shape[1]
    mixing = np.zeros((2, rank, rank, len(entries)))
    for place, (row, column, kind) in enumerate(entries):
        mixing[kind, :, :, place] = np.outer(basis[row], basis[column])
    return mixing.reshape(2 * rank**2, len(entries))


def kinds(points: ContactPoints) -> Array:
    """Return all that says which tangents points have, shape (kinds, points)."""
    acting = (
        each != 0.0 for each in (points.stiffness, points.damping, points.viscous)
    )
    return np.array([points.normal, points.friction, points.constant_load, *acting])
