"""Normal forces and energies of the contacts over one period (theory §6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, contact_power
from microslip_mechanics.contact.points import PUSHED, ContactPoints
from microslip_mechanics.jit import kernel


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


def contact_cycle(
    points: ContactPoints,
    moved: tuple[Array, Array],
    forces: Array,
    seen: int,
    period: float,
) -> ContactCycle:
    """Return normal forces and energies over one period.

    Parameters
    ----------
    points
        Contact table.
    moved
        Displacement and velocity of the points, shape ``(3 points, samples)`` each.
    forces
        Of the points [N], the same shape.
    seen
        Number of samples that tell the energies.
    period
        [s].
    """
    smallest, largest, powers = _seen(points, *moved, forces, seen)
    return ContactCycle(smallest, largest, *(float(p) * period for p in powers))


@kernel
def _seen(
    points: ContactPoints,
    displacement: Array,
    velocity: Array,
    forces: Array,
    seen: int,
) -> tuple[Array, Array, Array]:
    """Return smallest and largest normal forces and mean dissipated powers."""
    count = points.load.size
    smallest, largest = np.full(count, np.inf), np.full(count, -np.inf)
    powers, unused = np.zeros(2), np.zeros((2, 3, 3))
    moved, moving, force = np.zeros(3), np.zeros(3), np.zeros(3)
    for point in range(count):
        for moment in range(seen):
            for axis in range(3):
                moved[axis] = displacement[3 * point + axis, moment]
                moving[axis] = velocity[3 * point + axis, moment]
            contact_force(points, point, moved, moving, force, unused[0], unused[1])
            smallest[point] = min(smallest[point], force[0])
            largest[point] = max(largest[point], force[0])
            # the displacement of what is pushed is a push
            works = points.friction[point] != PUSHED
            for axis in range(1, 3):
                force[axis] = forces[3 * point + axis, moment] if works else 0.0
            slid, damped = contact_power(points, point, moved, moving, force)
            powers[0] += slid / seen
            powers[1] += damped / seen
    return smallest, largest, powers
