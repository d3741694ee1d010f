"""Which modes of the stuck structure count in small motions (theory §6.4)."""

from __future__ import annotations

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.structure import Structure

SMALLEST = 0.004
"""root of a mode's part in the inertia of y, by mass or by dashpots, over its
frequency, relative to the largest of all modes, and of its part in the inertia of
other modes by Coriolis forces; what has less is left out"""


def counting_modes(
    structure: Structure, static: Array, modes: Array, squares: Array
) -> NDArray[np.bool_]:
    """Return which stuck modes count, ``squares`` being those of their frequencies.

    Coriolis forces couple modes that inertia does not: an amount G of them makes up
    (G/ω)² of a slower mode's inertia. Then all up to the fastest that counts are kept.
    """
    inertia = static.T @ structure.mass @ static
    coupling = modes.T @ structure.mass @ static
    dashpots = modes.T @ structure.damping @ static
    part: Array = sum(
        (each.T * scipy.linalg.solve(inertia, each.T)).sum(axis=0) / scale
        for each, scale in ((coupling, 1.0), (dashpots, squares))
    )
    weight = np.sqrt(np.maximum(part, 0.0) / squares)
    kept: NDArray[np.bool_] = weight >= SMALLEST * weight.max(initial=0.0)
    if structure.gyroscopic:
        swerve = np.abs(modes.T @ structure.damping @ modes)
        np.fill_diagonal(swerve, 0.0)
        kept |= swerve.max(axis=0, initial=0.0) >= SMALLEST * np.sqrt(squares)
        kept = squares <= squares[kept].max(initial=0.0)
    return kept
