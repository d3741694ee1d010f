"""A test with sines: sweeps and steps, up and down, at one level or at several."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.segments import Segments, after_ramp

Growth: TypeAlias = Literal["exponential", "linear"]


@dataclass(frozen=True, slots=True)
class Tone:
    """A stretch of the drive: a sine from one frequency to another."""

    first: float
    """[Hz]"""
    last: float
    """[Hz]"""
    length: float
    """[s]"""
    level: float = 1.0
    """over the drive of the problem; 0 leaves the structure alone"""
    growth: Growth = "exponential"
    """of the frequency"""

    def __post_init__(self) -> None:
        """Check frequencies, length and level."""
        if not (0.0 < self.first < math.inf and 0.0 < self.last < math.inf):
            raise ValueError(
                f"frequencies {self.first:g} and {self.last:g} Hz: "
                "give positive finite ones"
            )
        if not 0.0 < self.length < math.inf:
            raise ValueError(f"length {self.length:g} s: give a positive finite one")
        if not 0.0 <= self.level < math.inf:
            raise ValueError(f"level {self.level:g}: give 0 or more")

    @property
    def sine(self) -> tuple[float, float, float]:
        """Frequency at the begin [rad/s], growth [1/s], linear rate [rad/s²]."""
        first, last = 2.0 * math.pi * self.first, 2.0 * math.pi * self.last
        if self.growth == "exponential":
            return first, math.log(self.last / self.first) / self.length, 0.0
        return first, 0.0, (last - first) / self.length

    @property
    def turns(self) -> float:
        """What the phase grows by [rad]."""
        frequency, growth, rate = self.sine
        if growth:
            return frequency * math.expm1(growth * self.length) / growth
        return (frequency + 0.5 * rate * self.length) * self.length


@dataclass(frozen=True, slots=True)
class SineTest:
    """Preload ramp, then one tone after another, then free."""

    ramp: float
    """the preload grows linearly from 0 until then [s]"""
    start: float
    """of the first tone [s]"""
    tones: tuple[Tone, ...]
    free: float
    """after the last tone [s]"""

    def __post_init__(self) -> None:
        """Check the times."""
        ordered = 0.0 <= self.ramp <= self.start < math.inf
        if not (ordered and self.tones and 0.0 <= self.free < math.inf):
            raise ValueError(
                f"ramp {self.ramp:g} s, start {self.start:g} s, {len(self.tones)} "
                f"tones, free {self.free:g} s: give 0 <= ramp <= start, at least one "
                "tone and a free time of 0 or more"
            )

    @property
    def duration(self) -> float:
        """Length [s]."""
        return self.start + sum(tone.length for tone in self.tones) + self.free

    def segments(self) -> Segments:
        """Return ramp, waiting, tones and free motion.

        The phase goes on from tone to tone; after a pause a sine begins at zero.
        """
        return after_ramp(self.ramp, self.start, np.array(list(self._rows())))

    def _rows(self) -> Iterator[tuple[float, ...]]:
        begin, phase = self.start, 0.0
        still = Tone(self.tones[-1].last, self.tones[-1].last, 1.0, 0.0)
        for before, tone in itertools.pairwise((still, *self.tones, still)):
            if before.level == 0.0 and tone.level > 0.0:
                phase = 2.0 * math.pi * math.ceil(phase / (2.0 * math.pi))
            yield (begin, 0.0, 0.0, tone.level, 0.0, phase, *tone.sine)
            begin, phase = begin + tone.length, phase + tone.turns


def stepped(frequencies: Array, *, periods: int, level: float = 1.0) -> list[Tone]:
    """Return a tone of so many periods at each frequency [Hz]."""
    return [
        Tone(float(each), float(each), periods / float(each), level)
        for each in frequencies
    ]
