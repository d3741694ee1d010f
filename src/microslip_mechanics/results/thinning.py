"""Fewer rows of a time history that look the same in a picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.results.time_history import TimeHistory


def thinned(history: TimeHistory, stride: int) -> TimeHistory:
    """Return two rows for each ``stride`` rows: their least and their largest values.

    Energies and errors are those at the stretch's end, so that their balance holds;
    times are those of its first and of its last row.
    """
    starts = np.arange(0, len(history.time), stride)
    ends = np.append(starts[1:], len(history.time)) - 1

    def extremes(values: Array) -> Array:
        low = np.minimum.reduceat(values, starts, axis=0)
        return _woven(low, np.maximum.reduceat(values, starts, axis=0))

    def last(values: Array) -> Array:
        return _woven(values[ends], values[ends]) if len(values) else values

    return replace(
        history,
        time=_woven(history.time[starts], history.time[ends]),
        displacement=extremes(history.displacement),
        velocity=extremes(history.velocity),
        normal_force=extremes(history.normal_force),
        friction_power=extremes(history.friction_power),
        energy=last(history.energy),
        frequency=last(history.frequency),
        level=last(history.level),
        energy_error=last(history.energy_error),
        peak_error=last(history.peak_error),
        work_difference=last(history.work_difference),
    )


def _woven(first: Array, second: Array) -> Array:
    """Return rows of both by turns."""
    return np.stack([first, second], axis=1).reshape(-1, *first.shape[1:])
