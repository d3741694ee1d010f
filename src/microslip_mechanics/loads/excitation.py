"""Load histories: how preload and drive vary with time."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.segments import Segments, after_ramp


class LoadHistory(Protocol):
    """Factors of preload and drive over time."""

    @property
    def duration(self) -> float:
        """Length [s]."""
        ...

    def segments(self) -> Segments:
        """Return the load factors piece by piece."""
        ...


@dataclass(frozen=True, slots=True)
class SweptSine:
    """Preload ramp, then an exponential swept sine, then free (theory, eq. 20)."""

    ramp: float
    """the preload grows linearly from 0 until then [s]"""
    start: float
    """[s]"""
    end: float
    """[s]"""
    duration: float
    """[s]"""
    lowest: float
    """frequency at the start [Hz]"""
    highest: float
    """frequency at the end [Hz]"""

    def __post_init__(self) -> None:
        """Check the order of the times, and the frequencies."""
        ordered = 0.0 <= self.ramp <= self.start < self.end <= self.duration
        if not (ordered and self.duration < math.inf):
            raise ValueError(
                f"ramp {self.ramp:g} s, start {self.start:g} s, end {self.end:g} s, "
                f"duration {self.duration:g} s: "
                "give finite times, 0 <= ramp <= start < end <= duration"
            )
        if not (0.0 < self.lowest < math.inf and 0.0 < self.highest < math.inf):
            raise ValueError(
                f"frequencies {self.lowest:g} and {self.highest:g} Hz: "
                "give positive finite ones"
            )
        if self.lowest == self.highest:
            raise ValueError(
                f"lowest and highest are both {self.lowest:g} Hz: a sweep needs two "
                "different frequencies"
            )

    @property
    def rate(self) -> float:
        """Logarithmic sweep rate k [1/s]."""
        return float(np.log(self.highest / self.lowest) / (self.end - self.start))

    def frequency(self, time: Array) -> Array:
        """Return the instantaneous frequency [Hz], held outside the sweep."""
        inside = np.clip(time, self.start, self.end) - self.start
        frequency: Array = self.lowest * np.exp(self.rate * inside)
        return frequency

    def segments(self) -> Segments:
        """Return ramp, waiting, sweep and free motion, those that take time."""
        low, high = 2.0 * np.pi * self.lowest, 2.0 * np.pi * self.highest
        turned = low * np.expm1(self.rate * (self.end - self.start)) / self.rate
        rows = (
            (self.start, 0.0, 0.0, 1.0, 0.0, 0.0, low, self.rate, 0.0),
            (self.end, 0.0, 0.0, 0.0, 0.0, turned, high, 0.0, 0.0),
        )
        return after_ramp(self.ramp, self.start, np.array(rows))


@dataclass(frozen=True, slots=True)
class Dwell:
    """Full preload and a sine of constant frequency."""

    frequency: float
    """[rad/s]"""
    duration: float
    """[s]"""

    def __post_init__(self) -> None:
        """Check that both are positive and finite."""
        if not 0.0 < self.frequency < math.inf:
            raise ValueError(
                f"frequency {self.frequency:g} rad/s: give a positive finite one"
            )
        if not 0.0 < self.duration < math.inf:
            raise ValueError(
                f"duration {self.duration:g} s: give a positive finite one"
            )

    def segments(self) -> Segments:
        """Return the one segment."""
        one, zero = np.array([[1.0, 0.0]]), np.zeros((1, 2))
        sine = np.array([[0.0, self.frequency, 0.0, 0.0]])
        return Segments(np.zeros(1), one, zero, one.copy(), sine)
