"""A periodic response: what harmonic balance returns at one frequency."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.by_value import ByValue

MARGIN = 1e-5
"""by which a Floquet multiplier outside the unit circle must exceed it: rounding moves
one that is double, as of a free mean position, by the root of its own size"""

FAINT = 1e-6
"""of the largest amplitude, below which changes of another one are shares of this"""

BEGINNINGS = ("restart", "detached", "branch")
"""events at which a curve begins anew"""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class PeriodicResponse(ByValue):
    """A periodic motion u = a₀ + Σ aₖ cos kωt + bₖ sin kωt under drive · sin ωt."""

    frequency: float
    """excitation frequency ω [rad/s]"""
    coefficients: Array
    """a₀, a₁, b₁, … [m or rad], shape (2 harmonics + 1, dofs)

    Where :attr:`shapes` are given: of its columns, in place of degrees of freedom.
    """
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
    harmonics: int = 0
    """that were solved for"""
    samples: int = 0
    """of the contacts per period"""
    error: float = np.inf
    """estimated relative error of the amplitude; infinite if it is not known"""
    friction_error: float = np.nan
    """estimated one of :attr:`friction_energy` [J]; NaN if none was asked for"""
    damping_error: float = np.nan
    """estimated one of :attr:`damping_energy` [J]"""
    normal_error: Array = field(default_factory=lambda: np.empty(0))
    """estimated one of smallest and largest normal forces [N], shape (points,); empty
    if none was asked for"""
    multipliers: ComplexArray = field(default_factory=lambda: np.empty(0, complex))
    """Floquet multipliers, the largest first; empty if they are not known"""
    event: str = ""
    """what the point is located as: peak, fold, …; empty for a point of the trace"""
    parameter: float = np.nan
    """of the scene, along which the point was found; ω itself along frequency"""
    parameter_error: float = np.nan
    """estimated one of the parameter at which a peak or a fold lies; NaN for others"""
    residual_range: Array = field(default_factory=lambda: np.empty((0, 0)))
    """by how much amplitudes of probes were found lower and higher, as shares of
    :func:`measure`, with other residual tractions of contacts that stick, shape
    (2, probes); NaN where they were sought in vain, empty where they were not
    (theory §6.5)"""
    replaces: int = 0
    """how many responses before it are taken back: more harmonics do not have them, or
    go there again"""
    shapes: Array | None = None
    """motion of the coordinates of a reduced structure, shape (dofs, coordinates)"""

    def __repr__(self) -> str:
        """Return what response it is, in a line."""
        event = f"; {self.event}" if self.event else ""
        return (
            f"<PeriodicResponse: {self.frequency / (2.0 * np.pi):.6g} Hz, "
            f"{self.harmonics} harmonics{event}; {self.outcome}>"
        )

    def seen(self, rows: Array) -> Array:
        """Return the coefficients of linear forms of the motion, shape (2H + 1, forms).

        ``rows`` has shape ``(forms, dofs)``.
        """
        if self.shapes is not None:
            rows = rows @ self.shapes
        found: Array = self.coefficients @ rows.T
        return found

    def amplitudes(self, rows: Array) -> Array:
        """Return the first harmonic of linear forms of the motion, shape (forms,)."""
        found: Array = np.hypot(*self.seen(rows)[1:3])
        return found

    def largest(self, rows: Array) -> float:
        """Return the largest of :meth:`amplitudes`, 0 of none."""
        return float(self.amplitudes(rows).max(initial=0.0))

    @property
    def unstable(self) -> int:
        """Number of multipliers outside the unit circle; −1 if they are not known."""
        if self.multipliers.size == 0:
            return -1
        return int((np.abs(self.multipliers) > 1.0 + MARGIN).sum())

    def at(self, phase: Array) -> tuple[Array, Array]:
        """Return displacement and velocity at phases ωt, each (phases, dofs)."""
        orders = np.arange(1, self.coefficients.shape[0] // 2 + 1)
        angles = np.multiply.outer(phase, orders)
        cosine, sine = np.cos(angles), np.sin(angles)
        even, odd = self.coefficients[1::2], self.coefficients[2::2]
        displacement = self.coefficients[0] + cosine @ even + sine @ odd
        rate = self.frequency * orders[:, None]
        velocity = cosine @ (rate * odd) - sine @ (rate * even)
        if self.shapes is None:
            return displacement, velocity
        return displacement @ self.shapes.T, velocity @ self.shapes.T


def measure(amplitude: Array) -> Array:
    """Return what changes of amplitudes are shares of [m], (probes,).

    It is an amplitude itself, unless the probe is at rest beside others: what a
    symmetry keeps still may move without it.
    """
    least = FAINT * amplitude.max(initial=0.0)
    large: Array = np.maximum(amplitude, least)
    return large
