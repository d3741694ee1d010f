"""One period of a motion as all methods are asked for it, and how two of them differ.

Samples at the same phases, and an energy: what a method gets wrong is seen alike,
whether it knows Fourier coefficients or steps.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.moving_probe import moving_probe
from microslip_mechanics.results.response import PeriodicResponse

PHASES = 128
"""of a period at which motions are compared"""
FINER = 16
"""times as many, between which the largest value is sought"""
QUANTITIES = ("amplitude", "energy", "distance")
"""that are compared: peak of a probe, energy per period, distance of orbits"""
RUBS = 1e-9
"""of all energy that is taken out: what friction takes out beyond it is no rounding"""


@dataclass(frozen=True, slots=True)
class Orbit:
    """A period of a motion."""

    displacement: Array
    """of the probes at equal steps of the phase, from 0 on [m], (PHASES, probes)"""
    friction: float
    """energy that friction takes out per period [J]"""
    damping: float
    """energy that all damping takes out, friction included [J]"""

    @property
    def rubs(self) -> bool:
        """Whether friction takes energy out: contacts may stick throughout."""
        return abs(self.friction) > RUBS * abs(self.damping)

    @property
    def energy(self) -> float:
        """Taken out per period [J]: by friction, or by all damping where none rubs."""
        return self.friction if self.rubs else self.damping

    @property
    def vibration(self) -> Array:
        """The displacement without its mean, of the same shape [m]."""
        mean: Array = self.displacement.mean(axis=0)
        return self.displacement - mean

    @property
    def peaks(self) -> Array:
        """Largest deviations of the probes from their means [m], shape (probes,).

        Between the samples they are trigonometric sums.
        """
        spectrum = np.fft.rfft(self.vibration, axis=0)
        fine = np.fft.irfft(spectrum, FINER * PHASES, axis=0) * FINER
        largest: Array = np.abs(fine).max(axis=0)
        return largest

    @property
    def peak(self) -> float:
        """That of the first probe that moves [m]."""
        return float(self.peaks[moving_probe(self.peaks)])

    def errors(self, exact: Orbit) -> tuple[float, float, float]:
        """Return the relative errors of :data:`QUANTITIES`.

        The peak is that of the probe by which ``exact`` is told, the energy that of its
        friction, or of all damping if it has none. The distance is the root mean square
        over time and probes.
        """
        energy = self.friction if exact.rubs else self.damping
        peak = float(self.peaks[moving_probe(exact.peaks)])
        away = float(np.linalg.norm(self.vibration - exact.vibration))
        size = max(float(np.linalg.norm(exact.vibration)), TINY)
        return (
            abs(peak - exact.peak) / max(exact.peak, TINY),
            abs(energy - exact.energy) / max(abs(exact.energy), TINY),
            away / size,
        )


def orbit_of(problem: Problem, response: PeriodicResponse) -> Orbit:
    """Return the orbit of a periodic response."""
    seen = response.seen(problem.probes.rows)
    work = drive_work(problem, response.seen(problem.loads[1:]))
    return Orbit(samples(seen), response.friction_energy, work)


def samples(coefficients: Array) -> Array:
    """Return the motion of coefficients a₀, a₁, b₁, … at the phases.

    Shape ``(PHASES, forms)``, of coefficients of shape ``(2 harmonics + 1, forms)``.
    """
    phase = 2.0 * math.pi * np.arange(PHASES) / PHASES
    orders = np.arange(1, len(coefficients) // 2 + 1)
    angles = np.multiply.outer(phase, orders)
    shown: Array = coefficients[0] + np.cos(angles) @ coefficients[1::2]
    return shown + np.sin(angles) @ coefficients[2::2]


def drive_work(problem: Problem, seen: Array) -> float:
    """Return the work of the drive per period [J], which all damping takes out.

    ``seen`` holds the coefficients of the displacement that each drive of
    ``problem.loads`` sees, of shape ``(2 harmonics + 1, drives)``: by the sine's drive
    D the work is −π D a₁, by the cosine's π D b₁.
    """
    work = -math.pi * seen[1, 0]
    if not problem.in_phase:
        work += math.pi * seen[2, 1]
    return float(work)
