"""Where to look at the response of a structure without contacts (theory §6.4).

Its poles and residues are known: they tell where the response changes, and how fast.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

import numpy as np
import scipy.optimize

from hbm.structure.condensed_structure import CondensedStructure
from microslip_mechanics.arrays import Array, ComplexArray

EVENLY = 100
"""parts of the range, beside what resonances ask for"""
ANGLES = np.deg2rad(np.arange(10.0, 90.0, 10.0))
"""phases behind that of a resonance at which its circle in the complex plane is seen"""
APART = 1.25
"""factor from which on the distances from a resonance grow"""
SEEN = 1e-3
"""part of the response that a pole must have at its resonance to be looked at"""
ROUNDING = 1e-11
"""of a resonance's frequency, relative"""
UNDAMPED, BESIDE = 1e-12, 1e-6
"""damping ratio that is none; and the one by which the points beside it are laid"""


class Place(NamedTuple):
    """Where to look."""

    frequency: float
    """[rad/s]"""
    error: float | None
    """of the frequency [rad/s] if the largest amplitude has a maximum there"""


@dataclass(frozen=True, slots=True)
class LinearCurve:
    """Order 1 of what the probes see of a structure without contacts."""

    poles: ComplexArray
    """λ [rad/s], shape (poles,)"""
    residues: ComplexArray
    """[m/s], shape (probes, poles)"""

    def places(self, start: float, end: float) -> Iterator[Place]:
        """Yield where to look from one frequency to another [rad/s]."""
        low, high = min(start, end), max(start, end)
        grid = np.linspace(low, high, EVENLY + 1)
        parts = [self._about(place, (high - low) / EVENLY) for place in self._telling()]
        beside = np.concatenate([np.zeros(0), *parts])
        inside = beside[(beside > low) & (beside < high)]
        points = np.unique(np.concatenate([grid, inside]))
        # none where the amplitude has no bound
        apart = np.abs(points[:, None] - self._endless)
        points = points[(apart > UNDAMPED * points[:, None]).all(axis=1)]
        found = [Place(float(each), None) for each in points]
        found += self._peaks(points)
        yield from sorted(
            found, key=lambda each: each.frequency, reverse=bool(start > end)
        )

    def unbounded(self, start: float, end: float) -> Array:
        """Return the resonances between two frequencies that nothing damps [rad/s]."""
        low, high = min(start, end), max(start, end)
        seen = np.array([pole.imag for pole in self._telling()])
        inside = (seen >= low) & (seen <= high) & np.isin(seen, self._endless)
        return np.sort(seen[inside])

    def amplitudes(self, frequency: float) -> Array:
        """Return the amplitude that each probe sees [m]."""
        size: Array = np.abs(self._value(frequency, 1))
        return size

    def growth(self, frequency: float) -> float:
        """Return half the change of the largest amplitude squared by frequency."""
        value = self._value(frequency, 1)
        largest = np.abs(value).argmax()
        change = -1j * self._value(frequency, 2)[largest]
        return float((value[largest].conj() * change).real)

    @property
    def _endless(self) -> Array:
        """Frequencies of resonances without damping [rad/s]."""
        damped = np.abs(self.poles.real) > UNDAMPED * np.abs(self.poles)
        undamped: Array = self.poles.imag[~damped]
        return undamped

    def _value(self, frequency: float, power: int) -> ComplexArray:
        return self.residues @ (1j * frequency - self.poles) ** -power

    def _telling(self) -> list[complex]:
        """Return the poles whose resonances are seen, once each."""
        told = []
        for place in np.flatnonzero(self.poles.imag > 0.0):
            pole = complex(self.poles[place])
            near = max(-pole.real, BESIDE * abs(pole))
            own = np.abs(self.residues[:, place]) / near
            if (own > SEEN * self.amplitudes(pole.imag + near)).any():
                told.append(pole)
        return told

    def _about(self, pole: complex, spacing: float) -> Array:
        """Return frequencies about the resonance of a pole, up to the even spacing."""
        damped = -pole.real > UNDAMPED * abs(pole)
        width = -pole.real if damped else BESIDE * abs(pole)
        near = width * np.tan(ANGLES)
        count = np.log(max(spacing / near[-1], 1.0)) / np.log(APART)
        far = near[-1] * APART ** np.arange(1, int(count) + 1)
        beside = np.concatenate([near, far])
        centre = [pole.imag] if damped else []
        return np.concatenate([pole.imag - beside, centre, pole.imag + beside])

    def _peaks(self, points: Array) -> Iterator[Place]:
        """Yield where the largest amplitude has a maximum between neighbours."""
        endless = self._endless
        growth = [self.growth(each) for each in points]
        for (low, rises), (high, falls) in pairwise(zip(points, growth, strict=True)):
            between = (endless > low) & (endless < high)
            if not rises > 0.0 > falls or between.any():
                continue
            near = 1e-3 * ROUNDING * high
            peak = scipy.optimize.brentq(self.growth, low, high, xtol=near, rtol=1e-15)
            yield Place(float(peak), ROUNDING * float(peak))


def linear_curve(
    condensed: CondensedStructure, drive: ComplexArray, rows: Array
) -> LinearCurve:
    """Return the curve of a structure condensed onto no coordinates.

    Parameters
    ----------
    condensed
        With all poles that the drive reaches.
    drive
        Load of order 1 [N], shape (dofs,).
    rows
        What the probes see of the motion, shape (probes, dofs).
    """
    excited = condensed.participation @ drive
    return LinearCurve(condensed.poles, (rows @ condensed.modes) * excited)
