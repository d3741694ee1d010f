"""What a march measures: energies by quadrature, probes and contact forces (§7.1)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_power
from microslip_mechanics.contact.memory import traction_energy
from microslip_mechanics.contact.normal import contact_energy
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel
from timedomain.contact.state import State

FLOWS = ("input", "friction", "normal_damping", "structural_damping")
"""integrated powers"""
FRICTION = FLOWS.index("friction")
STORES = ("kinetic", "elastic", "contact")
"""stored energies"""


def row_length(probes: int, points: int) -> int:
    """Return the length of a stored row."""
    return 2 * probes + points + 1 + len(FLOWS) + len(STORES)


class Meters(NamedTuple):
    """Matrices of what is measured, and the integrals so far."""

    mass: Array
    damping: Array
    stiffness: Array
    shapes: Array
    """loads, shape (dofs, loads)"""
    probes: Array
    """shape (probes, dofs)"""
    powers: Array
    """of FLOWS at the last step [W], shape (4,)"""
    energies: Array
    """of FLOWS so far [J], shape (4,); that of friction with what it stores"""


@kernel
def accumulate(
    meters: Meters, points: ContactPoints, state: State, factors: Array, step: float
) -> None:
    """Add the work of one step to the energies, by the trapezoidal rule (eq. 25)."""
    friction, damping = 0.0, 0.0
    for point in range(points.load.size):
        slid, damped = contact_power(
            points, point, state.gaps[point], state.slips[point], state.forces[point]
        )
        friction += slid
        damping += damped
    velocity = state.velocity
    powers = (
        np.dot(np.dot(meters.shapes, factors), velocity),
        friction,
        damping,
        np.dot(velocity, np.dot(meters.damping, velocity)),
    )
    for flow in range(4):
        meters.energies[flow] += 0.5 * step * (meters.powers[flow] + powers[flow])
        meters.powers[flow] = powers[flow]


@kernel
def store(meters: Meters, points: ContactPoints, state: State, row: Array) -> None:
    """Write probes, their velocities, normal forces, friction power and energies.

    Friction that remembers has taken in what its springs k_t store beside what it has
    dissipated.
    """
    probes, count = meters.probes.shape[0], points.load.size
    displacement, velocity = state.displacement, state.velocity
    np.dot(meters.probes, displacement, row[:probes])
    np.dot(meters.probes, velocity, row[probes : 2 * probes])
    place = 2 * probes
    pressed, stuck = 0.0, 0.0
    for point in range(count):
        row[place + point] = state.forces[point, 0]
        pressed += contact_energy(points, point, state.gaps[point, 0])
        stuck += traction_energy(points, point, state.past[point, 1])
    place += count
    row[place] = meters.powers[1]
    for flow in range(4):
        row[place + 1 + flow] = meters.energies[flow]
    row[place + 1 + FRICTION] -= stuck
    row[place + 5] = 0.5 * np.dot(velocity, np.dot(meters.mass, velocity))
    row[place + 6] = 0.5 * np.dot(displacement, np.dot(meters.stiffness, displacement))
    row[place + 7] = pressed + stuck
