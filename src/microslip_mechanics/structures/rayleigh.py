"""Damping proportional to mass and stiffness."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Matrix
from microslip_mechanics.structures.structure import Structure


@dataclass(frozen=True, slots=True)
class Rayleigh:
    """C = α M + β K: at the frequency ω the ratio α/(2ω) + βω/2."""

    mass: float = 0.0
    """α [1/s]"""
    stiffness: float = 0.0
    """β [s]"""

    def __post_init__(self) -> None:
        """Check that both are finite and none is negative."""
        for name in ("mass", "stiffness"):
            value = getattr(self, name)
            if not 0.0 <= value < np.inf:
                raise ValueError(
                    f"damping by {name} {value:g}: give zero or a positive number"
                )

    @classmethod
    def of_ratios(
        cls, frequencies: tuple[float, float], ratios: tuple[float, float]
    ) -> Rayleigh:
        """Return the damping with given ratios at two frequencies [rad/s].

        Raises
        ------
        ValueError
            If the frequencies are not positive and different, or if the ratios lie so
            far apart that a coefficient would be negative.
        """
        first, second = frequencies
        if not (0.0 < first < np.inf and 0.0 < second < np.inf and first != second):
            raise ValueError(
                f"frequencies {first:g} and {second:g} rad/s: "
                "give two different positive ones"
            )
        rows = np.array([[0.5 / each, 0.5 * each] for each in frequencies])
        mass, stiffness = np.linalg.solve(rows, ratios)
        if min(ratios) < 0.0 or min(mass, stiffness) < -1e-12 * max(mass, stiffness):
            raise ValueError(
                f"ratios {ratios[0]:g} and {ratios[1]:g} at {first:g} and {second:g} "
                "rad/s need a negative coefficient: give ratios that differ less, "
                "or modal damping"
            )
        return cls(max(0.0, float(mass)), max(0.0, float(stiffness)))

    def matrix(self, structure: Structure) -> Matrix:
        """Return C [N s/m], sparse if the structure is."""
        return self.mass * structure.mass + self.stiffness * structure.stiffness

    def rate(self, frequency: float) -> float:
        """Return 2ζω of a mode with the frequency ω [rad/s]."""
        return self.mass + self.stiffness * frequency**2
