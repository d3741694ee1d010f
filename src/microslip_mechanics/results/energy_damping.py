"""Damping of a decay by what its cycles dissipate, as modes have it (theory §6.8)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.ring_down import RingDown
from microslip_mechanics.results.time_history import TimeHistory

LOSSES = ("friction", "normal_damping", "structural_damping")
KNOWN, SMALL = 1e-3, 1e-4
"""relative error up to which a ratio is known, and ratio below which it is of that"""


def energy_damping(history: TimeHistory, decay: RingDown, *, every: int = 1) -> Array:
    """Return the damping ratio that each swing's energies have, shape (swings,).

    The rate of a mode is β = W / (4 ∫ T dt), with the energy W that a cycle dissipates
    and the kinetic energy T, of the whole structure. A linear decay falls by that; an
    amplitude on which the frequency depends falls faster or more slowly (theory, eq.
    27a).

    Parameters
    ----------
    history
        The march of the decay; each ``every``-th row is read.
    decay
        Its swings. Each has two cycles about it, from extreme to extreme, between which
        friction turns over: the mean of both is told. NaN where so little is left that
        rounding hides what it loses.
    """
    time, kinetic = history.time[::every], history.of("kinetic")[::every]
    lost = np.sum([history.of(each)[::every] for each in LOSSES], axis=0)
    means = 0.5 * np.diff(time) * (kinetic[1:] + kinetic[:-1])
    # from the end on: what is left late is small beside what was there before
    moved = -np.append(np.cumsum(means[::-1])[::-1], 0.0)
    cycle = 2.0 * np.pi / (decay.frequency * np.sqrt(1.0 - decay.damping**2))
    extremes = decay.time + np.outer([-0.75, -0.25, 0.25, 0.75], cycle)
    spent, action = (
        np.array([-1.0, -1.0, 1.0, 1.0]) @ np.interp(extremes, time, each)
        for each in (lost, moved)
    )
    whole = 4.0 * action * decay.frequency
    # each step adds to what is lost so far
    rounding = 0.5 * np.spacing(lost.max()) * cycle / history.time_step
    known = rounding <= KNOWN * np.maximum(spent, SMALL * whole)
    ratio = np.full(known.size, np.nan)
    np.divide(spent, whole, out=ratio, where=known & (whole > 0.0))
    return ratio
