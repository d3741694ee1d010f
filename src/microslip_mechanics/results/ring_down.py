"""Frequency and damping of a decaying motion, swing by swing."""

from __future__ import annotations

import itertools
from dataclasses import dataclass, field

import numpy as np

from microslip_mechanics.arrays import Array

FAINT = 1e-9
"""amplitude over the largest deflection at which a decay has ended"""
FEWEST = 4
"""extremes that a damping ratio needs"""
FEWEST_ROWS = 12
"""in each cycle, of which extremes and the turning of a motion can be told"""


@dataclass(frozen=True, slots=True)
class RingDown:
    """A decay, one value for each swing from an extreme to the next but two."""

    time: Array
    """in the middle [s], shape (swings,)"""
    amplitude: Array
    """there [m], shape (swings,)"""
    frequency: Array
    """natural, that is of the undamped motion [rad/s], shape (swings,)"""
    damping: Array
    """ratio, from the logarithmic decrement of a cycle, shape (swings,)"""
    energy_damping: Array = field(default_factory=lambda: np.zeros(0))
    """ratio, from the energies of a cycle, like ``damping``, or empty if not told"""

    def until(self, count: int) -> RingDown:
        """Return so many swings of it, the first ones."""
        columns = (
            *(self.time, self.amplitude, self.frequency),
            *(self.damping, self.energy_damping),
        )
        return RingDown(*(each[:count] for each in columns))


def ring_down(
    time: Array, displacement: Array, velocity: Array, *, rest: float = 0.0
) -> RingDown:
    """Measure a decay about a place of rest.

    Between two crossings of the place of rest lies one extreme, at which the cubic
    through the rows (with their velocities) has no slope. Half of the way from one
    extreme to the next is free of a constant offset; it falls by exp(−πζ/√(1−ζ²)) each
    half cycle of a linear decay, and by 2F/k of one against constant friction F.

    The natural frequency is √(ω² + a″/a) of the one with which the motion turns and the
    envelope a, with one a″/a over three swings: exact for both decays, since a dashpot
    slows the motion by ζ²/2 of its frequency and constant friction does not. Where a
    stop holds a motion on one side half cycles are not alike, and bend to and fro: the
    mean of neighbours is taken.

    Parameters
    ----------
    time, displacement, velocity
        Rows of the motion [s, m, m/s], shape (rows,): ``FEWEST_ROWS`` or more to a
        cycle, which ``cycle_rows`` counts.
    rest
        Where it comes to rest [m].
    """
    moments, extremes = _extremes(time, displacement - rest, velocity)
    swing = 0.5 * np.abs(np.diff(extremes))
    faint = swing <= FAINT * np.abs(displacement - rest).max()
    if faint.any():  # what is left swings in the last digits
        last = int(faint.argmax())
        swing, moments = swing[:last], moments[: last + 1]
    if moments.size < FEWEST:
        return no_swings()
    middle = 0.5 * (moments[1:] + moments[:-1])
    half = 0.5 * (middle[2:] - middle[:-2])
    decrement = np.log(swing[:-2] / swing[2:])
    return RingDown(
        middle[1:-1],
        np.sqrt(swing[:-2] * swing[2:]),
        np.sqrt(np.pi**2 + _bent(swing)) / half,
        decrement / np.hypot(2.0 * np.pi, decrement),
    )


def _bent(swing: Array) -> Array:
    """Return a″/a of half a cycle, shape (swings - 2,)."""
    curved = 0.5 * (swing[:-2] + swing[2:]) / swing[1:-1]
    bent = (np.arccosh(curved.astype(complex)) ** 2).real
    beside = np.pad(bent, 1, mode="reflect")
    beside = 0.5 * (beside[:-2] + beside[2:])
    found: Array = np.where(bent * beside < 0.0, 0.5 * (bent + beside), bent)
    return found


def no_swings() -> RingDown:
    """Return the decay of which nothing can be told."""
    none = np.zeros(0)
    return RingDown(none, none, none, none)


def cycle_rows(
    time: Array, displacement: Array, velocity: Array, *, rest: float = 0.0
) -> float:
    """Return how many rows a cycle of a motion about a place of rest has.

    Its frequency is that of the root mean squares of velocity and displacement, which
    rows too far apart to show the swings tell as well. Infinite without velocity.

    Parameters
    ----------
    time, displacement, velocity, rest
        As ``ring_down`` takes them.
    """
    size = float(np.linalg.norm(displacement - rest))
    turning = float(np.linalg.norm(velocity)) * (time[-1] - time[0])
    if turning == 0.0:
        return float("inf")
    return float(2.0 * np.pi * size * (time.size - 1) / turning)


def _extremes(time: Array, place: Array, velocity: Array) -> tuple[Array, Array]:
    """Return time and displacement of the extreme between any two crossings."""
    crossings = np.flatnonzero(np.diff(np.signbit(place))) + 1
    moments, extremes = [], []
    for first, last in itertools.pairwise(crossings):
        row = first + int(np.argmax(np.abs(place[first:last])))
        away = velocity[row] * place[row] > 0.0
        left = row if away else row - 1
        rows = slice(left, left + 2)
        share, height = _top(np.diff(time[rows])[0], place[rows], velocity[rows])
        moments.append(time[left] + share * np.diff(time[rows])[0])
        extremes.append(height)
    return np.array(moments), np.array(extremes)


def _top(step: float, place: Array, velocity: Array) -> tuple[float, float]:
    """Return where in a step its cubic has no slope, from 0 to 1, and its value there.

    With x(s) = x₀ + h v₀ s + b s² + a s³, of which the other end gives a and b.
    """
    rise, first, last = place[1] - place[0], step * velocity[0], step * velocity[1]
    cubic = first + last - 2.0 * rise
    square = 3.0 * rise - 2.0 * first - last
    root = np.sqrt(max(0.0, square**2 - 3.0 * cubic * first))
    below = -square + np.copysign(root, -square)
    share = float(np.clip(first / below if below else 0.0, 0.0, 1.0))
    height = place[0] + share * (first + share * (square + share * cubic))
    return share, float(height)
