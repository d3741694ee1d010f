"""A force given by its values in time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.segments import Segments, after_ramp


@dataclass(frozen=True, slots=True)
class ForceRecord:
    """Preload ramp, then a force with straight lines between its values, then free."""

    ramp: float
    """the preload grows linearly from 0 until then [s]"""
    start: float
    """where the record's time is zero [s]"""
    time: Array
    """increasing, from 0 or later [s], shape (values,)"""
    factor: Array
    """of the problem's drive, shape (values,)"""
    free: float
    """after the last value [s]"""
    clock: float
    """frequency [Hz] of the cycles that an envelope counts"""

    def __post_init__(self) -> None:
        """Check times and values."""
        if not 0.0 <= self.ramp <= self.start < math.inf:
            raise ValueError(
                f"ramp {self.ramp:g} s, start {self.start:g} s: give 0 <= ramp <= start"
            )
        if self.time.shape != self.factor.shape or self.time.size < 2:
            raise ValueError("a force needs at least two times with a value each")
        finite = np.isfinite(self.time).all() and np.isfinite(self.factor).all()
        if not (finite and self.time[0] >= 0.0 and (np.diff(self.time) > 0.0).all()):
            raise ValueError("times of a force must increase from 0 or later")
        if not (0.0 <= self.free < math.inf and 0.0 < self.clock < math.inf):
            raise ValueError(
                f"free {self.free:g} s, clock {self.clock:g} Hz: give a free time of "
                "0 or more and a positive frequency"
            )

    @property
    def duration(self) -> float:
        """Length [s]."""
        return float(self.start + self.time[-1] + self.free)

    def segments(self) -> Segments:
        """Return ramp, waiting, the record's straight pieces, and free motion."""
        time, value = self.time, self.factor
        slope = np.diff(value) / np.diff(time)
        if time[0] > 0.0:
            time, value = np.append(0.0, time), np.append(0.0, value)
            slope = np.append(0.0, slope)
        rows = np.zeros((time.size, 9))
        frequency = 2.0 * math.pi * self.clock
        rows[:, 0] = self.start + time
        rows[:-1, 1], rows[:-1, 2] = value[:-1], slope
        rows[:, 5], rows[:, 6] = frequency * time, frequency
        return after_ramp(self.ramp, self.start, rows)
