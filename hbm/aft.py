"""Alternating frequency/time: contact forces and their tangents (theory §6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.fourier import FourierBasis, Transform, derivative, to_complex
from hbm.jacobian import Spectra
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.law import (
    ContactPoints,
    contact_force,
    contact_power,
    tangent_pattern,
)
from microslip_mechanics.jit import kernel


@dataclass(frozen=True, slots=True)
class PeriodicContact:
    """Contact forces of a periodic relative motion, in the frequency domain."""

    force: Array
    """coefficients of the force on the relative coordinates [N], (2H + 1, rank)"""
    by_frequency: Array
    """its derivative by ω at constant coefficients [N s/rad], (2H + 1, rank)"""
    tangents: Spectra
    """of ∂force/∂y and ∂force/∂ẏ over the period, up to order 2H"""


@dataclass(frozen=True, slots=True)
class ContactCycle:
    """What one period of the contacts shows in time."""

    normal_smallest: Array
    """[N], shape (points,)"""
    normal_largest: Array
    """[N], shape (points,)"""
    friction: float
    """energy that friction takes out per period [J]"""
    normal_damping: float
    """energy that normal damping takes out per period [J]"""


class AlternatingFrequencyTime:
    """Contact points evaluated over the samples of one period."""

    def __init__(
        self, points: ContactPoints, basis: Array, fourier: FourierBasis
    ) -> None:
        """Plan the transforms; ``basis`` maps y to the points, (3 points, rank)."""
        self._points, self._basis, self._fourier = points, basis, fourier
        rows = basis.shape[0]
        self._displacement = Transform(rows, fourier.samples)
        self._velocity = Transform(rows, fourier.samples)
        self._force = Transform(rows, fourier.samples)
        self._change = Transform(rows, fourier.samples)
        self._entries = _entries(points)
        self._tangents = Transform(len(self._entries), fourier.samples)

    def __call__(self, coefficients: Array, frequency: float) -> PeriodicContact:
        """Return force and tangents for y with ``coefficients``, (2H + 1, rank).

        ``frequency`` [rad/s] turns the derivative by phase into velocity.
        """
        displacement, velocity = self._motion(coefficients, frequency)
        _sample(
            self._points,
            displacement,
            velocity,
            self._entries,
            self._force.samples,
            self._change.samples,
            self._tangents.samples,
        )
        harmonics = self._fourier.harmonics
        force = self._force.analysis(harmonics) @ self._basis
        change = self._change.analysis(harmonics) @ self._basis / frequency
        spectrum = to_complex(self._tangents.analysis(2 * harmonics))
        stiffness, damping = (self._spectrum(spectrum, kind) for kind in (0, 1))
        parts = (stiffness.real, -stiffness.imag, damping.real, -damping.imag)
        spectra = Spectra(*(np.ascontiguousarray(p.transpose(1, 2, 0)) for p in parts))
        return PeriodicContact(force, change, spectra)

    def cycle(self, coefficients: Array, frequency: float) -> ContactCycle:
        """Return normal forces and energies over one period."""
        displacement, velocity = self._motion(coefficients, frequency)
        smallest, largest, powers = _cycle(self._points, displacement, velocity)
        period = 2.0 * np.pi / frequency
        return ContactCycle(smallest, largest, *(float(p) * period for p in powers))

    def _motion(self, coefficients: Array, frequency: float) -> tuple[Array, Array]:
        at_points = coefficients @ self._basis.T
        velocities = frequency * derivative(at_points)
        return (
            self._displacement.synthesis(at_points),
            self._velocity.synthesis(velocities),
        )

    def _spectrum(self, amplitudes: ComplexArray, by_velocity: int) -> ComplexArray:
        """Return the spectrum of one kind of tangent on the relative coordinates.

        They are brought there order by order, before the products of harmonics
        multiply their number (theory, eq. 19).
        """
        rows = self._basis.shape[0]
        chosen = self._entries[:, 2] == by_velocity
        entries = self._entries[chosen]
        dense: ComplexArray = np.zeros((amplitudes.shape[0], rows, rows), complex)
        dense[:, entries[:, 0], entries[:, 1]] = amplitudes[:, chosen]
        spectrum: ComplexArray = self._basis.T @ dense @ self._basis
        return spectrum


def _entries(points: ContactPoints) -> NDArray[np.int64]:
    """Return (row, column, by velocity) of the tangents that can differ from zero."""
    rows = []
    for point in range(len(points.load)):
        for kind, pattern in enumerate(tangent_pattern(points, point)):
            for row, column in np.argwhere(pattern):
                rows.append((3 * point + row, 3 * point + column, kind))
    return np.array(rows, dtype=np.int64).reshape(-1, 3)


@kernel
def _sample(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    entries: NDArray[np.int64],
    forces: Array,
    changes: Array,
    tangents: Array,
) -> None:
    """Write forces, (∂force/∂velocity) velocity, and chosen tangents at all samples."""
    moved, moving, force = np.zeros(3), np.zeros(3), np.zeros(3)
    by_displacement, by_velocity = np.zeros((3, 3)), np.zeros((3, 3))
    first = 0
    for point in range(points.load.size):
        last = first
        while last < entries.shape[0] and entries[last, 0] < 3 * point + 3:
            last += 1
        for sample in range(displacement.shape[1]):
            for axis in range(3):
                moved[axis] = displacement[3 * point + axis, sample]
                moving[axis] = velocity[3 * point + axis, sample]
            contact_force(
                points, point, moved, moving, force, by_displacement, by_velocity
            )
            for axis in range(3):
                forces[3 * point + axis, sample] = force[axis]
                changes[3 * point + axis, sample] = (
                    by_velocity[axis, 0] * moving[0]
                    + by_velocity[axis, 1] * moving[1]
                    + by_velocity[axis, 2] * moving[2]
                )
            for entry in range(first, last):
                row = entries[entry, 0] - 3 * point
                column = entries[entry, 1] - 3 * point
                if entries[entry, 2] == 0:
                    tangents[entry, sample] = by_displacement[row, column]
                else:
                    tangents[entry, sample] = by_velocity[row, column]
        first = last


@kernel
def _cycle(
    points: ContactPoints, displacement: Array, velocity: Array
) -> tuple[Array, Array, Array]:
    """Return smallest and largest normal forces and mean dissipated powers."""
    count, samples = points.load.size, displacement.shape[1]
    smallest, largest = np.full(count, np.inf), np.full(count, -np.inf)
    powers = np.zeros(2)
    force = np.zeros(3)
    unused = np.zeros((2, 3, 3))
    for point in range(count):
        place = slice(3 * point, 3 * point + 3)
        for sample in range(samples):
            moved, moving = displacement[place, sample], velocity[place, sample]
            contact_force(points, point, moved, moving, force, unused[0], unused[1])
            smallest[point] = min(smallest[point], force[0])
            largest[point] = max(largest[point], force[0])
            slid, damped = contact_power(points, point, moved, moving, force)
            powers[0] += slid / samples
            powers[1] += damped / samples
    return smallest, largest, powers
