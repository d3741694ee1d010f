"""A sliding point in harmonic motion, and what sampling makes of its force."""

import numpy as np

from contact_tables import contact_points
from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis, to_complex, to_real
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.points import ContactPoints

FREQUENCY, SPEED, LOAD, FRICTION = 11.0, 0.2, 1.7, 0.3
HARMONICS, SAMPLES = 5, 64
TURN = 2.0 * np.pi


def sliding_point(threshold: float, **columns: float) -> ContactPoints:
    """Return a point with a constant normal load and no force across."""
    values = {"dynamic": FRICTION, "load": LOAD, "threshold": threshold} | columns
    return contact_points(1, stiffness=0.0, damping=0.0, constant_load=True, **values)


def motion(phase: float, *, mean: float = 0.0, across: float = 0.0) -> Array:
    """Return a motion with the sliding velocity V sin(θ − phase), (2H + 1, 3).

    The faces approach each other by mean + across · cos(θ − phase − 1).
    """
    moved = np.zeros((HARMONICS + 1, 3), complex)
    moved[1, 1] = -SPEED / FREQUENCY * np.exp(-1j * phase)
    moved[0, 0], moved[1, 0] = mean, across * np.exp(-1j * (phase + 1.0))
    return to_real(moved)


def coefficients(
    points: ContactPoints, moved: Array, samples: int = SAMPLES
) -> ComplexArray:
    """Return the force's amplitudes by orders, shape (H + 1, 3)."""
    fourier = FourierBasis(HARMONICS, samples)
    contact = AlternatingFrequencyTime(points, np.eye(3), fourier)
    return to_complex(contact(moved, FREQUENCY))


def turned(amplitudes: ComplexArray, phase: float) -> ComplexArray:
    """Return amplitudes of what happens ``phase`` later."""
    orders = np.arange(len(amplitudes)).reshape(-1, *[1] * (amplitudes.ndim - 1))
    later: ComplexArray = amplitudes * np.exp(-1j * orders * phase)
    return later
