"""Normal forces and energies of the contacts over one period (theory §6.6)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hbm.forces.refinement import node
from hbm.forces.steep_edge import steepness
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import (
    contact_force,
    contact_power,
    damping_power,
    edge,
)
from microslip_mechanics.contact.points import ONE_SIDED, PUSHED, ContactPoints
from microslip_mechanics.jit import inner_kernel, kernel


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

    @property
    def values(self) -> Array:
        """All of it in a row: energies, smallest and largest forces."""
        energies = self.friction, self.normal_damping
        return np.concatenate([energies, self.normal_smallest, self.normal_largest])

    @property
    def ranges(self) -> Array:
        """What normal forces range over in the period, in that row; 0 for energies."""
        ranges = self.normal_largest - self.normal_smallest
        return np.concatenate([np.zeros(2), ranges, ranges])

    def with_values(self, values: Array) -> ContactCycle:
        """Return a cycle with other values in such a row."""
        smallest, largest = np.split(values[2:], 2)
        return ContactCycle(smallest, largest, float(values[0]), float(values[1]))

    def joined(self, images: NDArray[np.int64]) -> ContactCycle:
        """Return it with the range of forces of each point's image, shape (points,)."""
        smallest, largest = self.normal_smallest, self.normal_largest
        return replace(
            self,
            normal_smallest=np.minimum(smallest, smallest[images]),
            normal_largest=np.maximum(largest, largest[images]),
        )


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
    slid, damped = (float(power) for power in powers)
    if ((points.normal == ONE_SIDED) & (points.damping != 0.0)).any():
        damped += _unseen(points, *moved, seen)
    return ContactCycle(smallest, largest, slid * period, damped * period)


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


@kernel
def _unseen(
    points: ContactPoints, displacement: Array, velocity: Array, seen: int
) -> float:
    """Return the mean power of normal damping besides what samples see of it."""
    missed = 0.0
    for point in range(points.load.size):
        if points.damping[point] != 0.0:
            missed += _missed(points, point, displacement, velocity, seen) / seen
    return missed


@inner_kernel
def _missed(
    points: ContactPoints,
    point: int,
    displacement: Array,
    velocity: Array,
    seen: int,
) -> float:
    """Return the sum of what samples do not see of a point's power, per sample.

    The power may jump as faces touch: between the two samples beside that the
    trapezoidal rule gives way to Gauss rules on both sides, as it does for forces.
    """
    row, touch, missed = 3 * point, edge(points, point), 0.0
    grade, events = steepness(points, point), np.array([0.0, 0.0, 1.0])
    nodes = 3 if grade == 1 else 4
    for place in range(seen):
        after = place + 1 if place + 1 < displacement.shape[1] else 0
        moved, moving = displacement[row, place], velocity[row, place]
        before, further = moved - touch, displacement[row, after] - moved
        faster = velocity[row, after] - moving
        if (before > 0.0) == (before + further > 0.0):
            continue
        for end in range(2):
            power = damping_power(
                points, point, moved + end * further, moving + end * faster
            )
            missed -= 0.5 * power
        events[1] = -before / further
        for piece in range(2 * nodes):
            share, weight = node(events, piece, nodes, before, further, grade)
            power = damping_power(
                points, point, moved + share * further, moving + share * faster
            )
            missed += weight * power
    return missed
