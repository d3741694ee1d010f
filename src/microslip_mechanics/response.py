"""What solvers return: a periodic response, a curve of them, a time history."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem


@dataclass(frozen=True, slots=True)
class PeriodicResponse:
    """A periodic motion u = a₀ + Σ aₖ cos kωt + bₖ sin kωt under drive · sin ωt."""

    frequency: float
    """excitation frequency ω [rad/s]"""
    coefficients: Array
    """a₀, a₁, b₁, … [m or rad], shape (2 harmonics + 1, dofs)"""
    normal_smallest: Array
    """of each contact point over the period [N], shape (points,)"""
    normal_largest: Array
    """[N], shape (points,)"""
    friction_energy: float
    """taken out by friction per period [J]"""
    damping_energy: float
    """taken out by normal contact damping per period [J]"""
    residual: float
    """largest unbalanced force [N]"""
    outcome: str
    """how Newton's correction ended"""
    iterations: int
    """Newton iterations that the point took"""

    def at(self, phase: Array) -> tuple[Array, Array]:
        """Return displacement and velocity at phases ωt, each (phases, dofs)."""
        orders = np.arange(1, self.coefficients.shape[0] // 2 + 1)
        angles = np.multiply.outer(phase, orders)
        cosine, sine = np.cos(angles), np.sin(angles)
        even, odd = self.coefficients[1::2], self.coefficients[2::2]
        displacement = self.coefficients[0] + cosine @ even + sine @ odd
        rate = self.frequency * orders[:, None]
        return displacement, cosine @ (rate * odd) - sine @ (rate * even)


@dataclass(frozen=True, slots=True)
class ResponseCurve:
    """A frequency response curve in the order in which it was traced."""

    frequency: Array
    """excitation frequency ω [rad/s], shape (points,)"""
    probes: tuple[str, ...]
    amplitude: Array
    """first harmonic of each probe [m], shape (points, probes)"""
    peak: Array
    """largest deviation from the mean in time [m], shape (points, probes)"""
    velocity_peak: Array
    """largest velocity in time [m/s], shape (points, probes)"""
    contacts: tuple[str, ...]
    normal_smallest: Array
    """[N], shape (points, contacts)"""
    normal_largest: Array
    """[N], shape (points, contacts)"""
    friction_energy: Array
    """per period [J], shape (points,)"""
    damping_energy: Array
    """of normal contact damping, per period [J], shape (points,)"""
    residual: Array
    """largest unbalanced force [N], shape (points,)"""
    outcome: tuple[str, ...]
    """how each point's correction ended"""
    iterations: Array
    """Newton iterations, shape (points,)"""
    ending: str
    """how the curve ended: "complete", "interrupted", or the cause"""


def response_curve(
    problem: Problem, points: Sequence[PeriodicResponse], ending: str, *, samples: int
) -> ResponseCurve:
    """Gather periodic responses to a curve; ``samples`` in time find the peaks."""
    phase = 2.0 * np.pi * np.arange(samples) / samples
    count = (len(points), len(problem.probes.names))
    amplitude, peak, velocity_peak = (np.empty(count) for _ in range(3))
    for place, point in enumerate(points):
        seen = _seen(point, problem.probes.rows)
        amplitude[place] = np.hypot(seen.coefficients[1], seen.coefficients[2])
        displacement, velocity = seen.at(phase)
        peak[place] = np.abs(displacement - seen.coefficients[0]).max(axis=0)
        velocity_peak[place] = np.abs(velocity).max(axis=0)
    contacts = problem.interface.count
    return ResponseCurve(
        np.array([p.frequency for p in points]),
        problem.probes.names,
        amplitude,
        peak,
        velocity_peak,
        problem.interface.names,
        np.array([p.normal_smallest for p in points]).reshape(len(points), contacts),
        np.array([p.normal_largest for p in points]).reshape(len(points), contacts),
        np.array([p.friction_energy for p in points]),
        np.array([p.damping_energy for p in points]),
        np.array([p.residual for p in points]),
        tuple(p.outcome for p in points),
        np.array([p.iterations for p in points], dtype=float),
        ending,
    )


def _seen(point: PeriodicResponse, rows: Array) -> PeriodicResponse:
    """Return the same response with probes in place of degrees of freedom."""
    return replace(point, coefficients=point.coefficients @ rows.T)
