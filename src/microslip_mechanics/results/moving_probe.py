"""The probe that stands for a motion where only one is shown."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array

MOVES = 0.1
"""of the motion of the probe that moves most, from which on another one moves"""


def moving_probe(sizes: Array) -> int:
    """Return the first probe that moves, :data:`MOVES` of the largest one at least.

    Where the drive does not reach, a probe shows nothing but rounding errors.

    Parameters
    ----------
    sizes
        How far each probe moves [m], of shape ``(…, probes)``; not known where NaN.
    """
    probes = np.abs(sizes).reshape(-1, np.shape(sizes)[-1])
    highest = np.nanmax(probes, axis=0, initial=0.0)
    return int(np.argmax(highest >= MOVES * highest.max()))
