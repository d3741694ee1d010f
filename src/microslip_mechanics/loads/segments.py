"""Load factors piece by piece, so that a compiled march can evaluate them."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import kernel


class Segments(NamedTuple):
    """Factors of preload and drive, each segment up to and with the next one's begin.

    With τ since its begin, a segment's drive is offset(τ) + amplitude(τ) sin(phase(τ)).
    The phase turns on where the amplitude is zero: it is the clock that counts cycles.
    """

    begin: Array
    """[s], increasing, the first 0, shape (segments,)"""
    preload: Array
    """value at the begin and rate [1/s], shape (segments, 2)"""
    offset: Array
    """of the drive, value at the begin and rate [1/s], shape (segments, 2)"""
    amplitude: Array
    """of the sine, value at the begin and rate [1/s], shape (segments, 2)"""
    sine: Array
    """phase [rad] and frequency [rad/s] at the begin, its exponential growth [1/s] and
    its linear rate [rad/s²], of which one is zero, shape (segments, 4)"""


@kernel
def load_factors(segments: Segments, time: float, hint: int, factors: Array) -> int:
    """Write the factors of preload and drive at a time; return its segment.

    With room for a third one, that of the drive's part a quarter of a period ahead is
    written too, which has the sine's cosine and no offset.
    ``hint`` is a segment at or near which the search begins, such as the last one.
    Times before 0 count as 0.
    """
    place = segment_of(segments, time, hint)
    elapsed = max(0.0, time - segments.begin[place])
    amplitude = _line(segments.amplitude[place], elapsed)
    factors[0] = _line(segments.preload[place], elapsed)
    factors[1] = _line(segments.offset[place], elapsed)
    if factors.size > 2:
        factors[2] = 0.0
    if amplitude != 0.0:
        phase = phase_of(segments.sine[place], elapsed)
        factors[1] += amplitude * math.sin(phase)
        if factors.size > 2:
            factors[2] = amplitude * math.cos(phase)
    return place


@kernel
def segment_of(segments: Segments, time: float, hint: int) -> int:
    """Return the segment in which a time lies, sought from ``hint`` on."""
    place = min(max(hint, 0), segments.begin.size - 1)
    while place > 0 and time <= segments.begin[place]:
        place -= 1
    while place + 1 < segments.begin.size and time > segments.begin[place + 1]:
        place += 1
    return place


@kernel
def phase_of(sine: Array, elapsed: float) -> float:
    """Return the phase [rad] so long after a segment's begin."""
    phase, frequency, growth, rate = sine[0], sine[1], sine[2], sine[3]
    if growth != 0.0:
        return float(phase + frequency * math.expm1(growth * elapsed) / growth)
    return float(phase + frequency * elapsed + 0.5 * rate * elapsed**2)


def after_ramp(ramp: float, start: float, rows: Array) -> Segments:
    """Return a preload ramp and a time of waiting, and then what drives from a start.

    Each row, shape ``(segments, 9)``, is begin, offset, amplitude and sine in the
    order of :class:`Segments`; the first begins at the start, where its phase is zero.
    The clock of the cycles has its frequency before.
    """
    frequency = rows[0, 6]
    waits = [begin for begin, end in ((0.0, ramp), (ramp, start)) if begin < end]
    before = np.zeros((len(waits), 9))
    before[:, 0] = waits
    before[:, 5] = rows[0, 5] - frequency * (start - before[:, 0])
    before[:, 6] = frequency
    table = np.concatenate([before, rows])
    preload = np.tile([1.0, 0.0], (len(table), 1))
    if ramp > 0.0:
        preload[0] = 0.0, 1.0 / ramp
    parts = (table[:, 0], preload, table[:, 1:3], table[:, 3:5], table[:, 5:])
    return Segments(*(np.ascontiguousarray(part) for part in parts))


def factors_over(segments: Segments, time: Array, loads: int = 2) -> Array:
    """Return the factors of preload and drive at many times, shape (times, loads)."""
    factors = np.empty((time.size, loads))
    _fill(segments, np.asarray(time, dtype=float), factors)
    return factors


def clock(segments: Segments, time: Array) -> Array:
    """Return frequency [rad/s], amplitude and phase [rad] of the sine at many times.

    Shape ``(times, 3)``.
    """
    shown = np.empty((time.size, 3))
    _read(segments, np.asarray(time, dtype=float), shown)
    return shown


@kernel
def _line(line: Array, elapsed: float) -> float:
    return float(line[0] + line[1] * elapsed)


@kernel
def _fill(segments: Segments, time: Array, factors: Array) -> None:
    place = 0
    for row in range(time.size):
        place = load_factors(segments, time[row], place, factors[row])


@kernel
def _read(segments: Segments, time: Array, shown: Array) -> None:
    place = 0
    for row in range(time.size):
        place = segment_of(segments, time[row], place)
        elapsed = max(0.0, time[row] - segments.begin[place])
        _, frequency, growth, rate = segments.sine[place]
        shown[row, 0] = frequency * math.exp(growth * elapsed) + rate * elapsed
        shown[row, 1] = _line(segments.amplitude[place], elapsed)
        shown[row, 2] = phase_of(segments.sine[place], elapsed)
