"""A periodic motion of the contact points between its samples (theory §6.1)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hbm.forces.aft import AlternatingFrequencyTime
from microslip_mechanics.arrays import Array, ComplexArray


@dataclass(frozen=True, slots=True)
class SampledOrbit:
    """A periodic motion of the contact points, known at any time."""

    spectrum: ComplexArray
    """Σ Re(c_k exp(i k θ)), shape (orders, 3 points)"""
    frequency: float
    """[rad/s]"""

    @classmethod
    def of(cls, contact: AlternatingFrequencyTime, frequency: float) -> SampledOrbit:
        """Return the orbit of the last call of ``contact``."""
        moved = contact.moved[0]
        spectrum = np.fft.rfft(moved, axis=1).T * (2.0 / moved.shape[1])
        spectrum[0] *= 0.5
        size = np.abs(spectrum).max(axis=1)
        filled = np.flatnonzero(size > 1e-13 * size.max(initial=0.0))
        return cls(spectrum[: filled.max(initial=1) + 1], frequency)

    def at(self, phase: Array) -> tuple[Array, Array]:
        """Return displacement and velocity, each of shape (times, points, 3)."""
        orders = np.arange(len(self.spectrum))
        waves = np.exp(1j * np.multiply.outer(phase, orders))
        rates = 1j * self.frequency * orders[:, None] * self.spectrum
        shape = (phase.size, -1, 3)
        moved = (waves @ self.spectrum).real.reshape(shape)
        return moved, (waves @ rates).real.reshape(shape)
