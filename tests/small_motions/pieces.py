"""Pieces of a period over which contact tangents vary smoothly and little."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from small_motions.relative_orbit import RelativeOrbit

SMALLEST, LARGEST = 2048, 65536
"""samples of a period in the search for transitions"""
HALVINGS = 40
"""of the sample in which a transition lies"""
PIECES = 24
"""besides those that transitions cut off"""


@dataclass(frozen=True, slots=True)
class Pieces:
    """A period cut at the transitions between sticking, sliding and separation."""

    edges: Array
    """phases [rad] from 0 to 2π, shape (pieces + 1,)"""
    shares: Array
    """of the steps that each piece deserves; their sum is 1, shape (pieces,)"""

    def steps(self, total: int) -> NDArray[np.int64]:
        """Return the number of steps of each piece, at least one: some more in all."""
        return np.maximum(1, np.ceil(self.shares * total)).astype(np.int64)


def pieces(orbit: RelativeOrbit) -> Pieces:
    """Cut a period at its transitions and where the tangents have varied enough.

    The steps are shared out half by time, half by √(|dk|/dt) of the tangents k, which
    gathers them where friction turns over and where a contact closes.
    """
    cuts = transitions(orbit)
    near = 2.0 * np.pi * 0.5 ** np.arange(3, 30)
    around = np.concatenate([cuts + each for each in (*near, *-near)])
    even = np.linspace(0.0, 2.0 * np.pi, SMALLEST + 1)
    inside = around[(around > 0.0) & (around < 2.0 * np.pi)]
    phase = np.unique(np.concatenate([even, inside, cuts]))
    need = np.concatenate([[0.0], np.cumsum(_need(orbit, phase))])
    quantiles = np.interp(np.linspace(0.0, 1.0, PIECES + 1), need, phase)
    quantiles[[0, -1]] = 0.0, 2.0 * np.pi
    edges = np.unique(np.concatenate([quantiles, cuts]))
    return Pieces(edges, np.diff(np.interp(edges, phase, need)))


def transitions(orbit: RelativeOrbit) -> Array:
    """Return the phases [rad] in (0, 2π) at which a point changes its regime."""
    count = orbit.samples(smallest=SMALLEST, largest=LARGEST)
    phase = np.linspace(0.0, 2.0 * np.pi, count + 1)
    regime = orbit.regimes(phase)
    sample, point = np.nonzero(regime[1:] != regime[:-1])
    low, high, before = phase[sample], phase[sample + 1], regime[sample, point]
    each = np.arange(sample.size)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        same = orbit.regimes(middle)[each, point] == before
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    found: Array = np.unique(high)
    return found[(found > 0.0) & (found < 2.0 * np.pi)]


def _need(orbit: RelativeOrbit, phase: Array) -> Array:
    """Return the share of the steps between neighbouring phases."""
    length = np.diff(phase)
    change = np.zeros_like(length)
    for tangent in orbit.tangents(phase):
        size = np.linalg.norm(tangent, axis=(1, 2))
        varied = np.linalg.norm(np.diff(tangent, axis=0), axis=(1, 2))
        change += varied / max(float(size.max()), 1e-300)
    gathered = np.sqrt(change * length)
    even = length / (2.0 * np.pi)
    if not gathered.sum() > 0.0:
        return even
    share: Array = 0.5 * (even + gathered / gathered.sum())
    return share
