"""What counts as one unit of arc along a path (theory §6.2)."""

from __future__ import annotations

import numpy as np

from hbm.paths.path import Path
from microslip_mechanics.arrays import Array

PUSHES = 10.0
"""of a push on rigid contacts, over that of a motion: change that counts as one unit of
arc; it jumps, so that every harmonic that is added changes it"""


def path_metric(path: Path, point: Array) -> Array:
    """Return the change of each component that counts as one unit of arc.

    Relative changes of mean motion and vibration each, and a tenth of the range: a
    preload makes mean values large, and must not hide the vibration. Means that
    are smaller than it count like it. Pushes on rigid contacts count less.
    """
    means = path.rank
    vibration = float(np.linalg.norm(point[means:-1]))
    vibration = path.measure(vibration, float(point[-1])) + 1e-15
    scale = np.full(point.size, vibration)
    scale[:means] = max(float(np.linalg.norm(point[:means])), vibration)
    tractions = path.at(float(point[-1]))[0].tractions
    if tractions is not None:
        pushes = scale[:-1].reshape(-1, means)[:, tractions.rows.shape[1] :]
        pushes *= PUSHES
    scale[-1] = path.unit(float(point[-1]))
    return scale
