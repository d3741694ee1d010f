"""What the errors of the fast march are compared with: what moves (theory, §7.2)."""

from __future__ import annotations

import math

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.loads.segments import Segments
from timedomain.contact.state import State
from timedomain.fast.coordinates import Modes


def least_energy(
    modes: Modes, inverse: Array, state: State, segments: Segments, step: float
) -> float:
    """Return twice the least energy [J] that errors are compared with.

    It is that of the drive as a static load, or of what sets the structure in motion at
    the begin: velocities, and forces that do not balance. A preload that balances is
    none of them, however large; one that grows counts where nothing else moves.

    Parameters
    ----------
    modes
        Of the structure.
    inverse
        Modes from the structure, shape (modes, dofs).
    state
        At the begin.
    segments
        Of the loads.
    step
        The longest [s].
    """
    flexibility = 1.0 / np.maximum(modes.stiffness, 1.0 / step**2)
    preload, *drives = (modes.loads**2 * flexibility).sum(axis=1)
    unbalanced, velocity = inverse @ state.acceleration, inverse @ state.velocity
    begun = float((unbalanced**2 * flexibility + velocity**2).sum())
    grows = preload if segments.preload[0, 1] != 0.0 else 0.0
    return float(max(*drives, begun) or grows) or TINY


def settled(segments: Segments) -> float:
    """Return the time until which a growing preload alone moves the structure [s].

    It is where the drive begins, or where the preload is constant if none does; 0 if
    the preload does not grow.
    """
    grows = np.flatnonzero(segments.preload[:, 1])
    if not grows.size:
        return 0.0
    drives = (segments.offset != 0.0) | (segments.amplitude != 0.0)
    driven = np.flatnonzero(drives.any(axis=1))
    place = max(grows[-1] + 1, driven[0] if driven.size else 0)
    return float(np.append(segments.begin, math.inf)[place])
