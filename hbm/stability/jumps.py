"""Forces that jump as faces touch, beside contacts that remember (theory §6.5)."""

from __future__ import annotations

import numpy as np

from hbm.forces.sampled_orbit import SampledOrbit
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.jump import contact_jump
from microslip_mechanics.contact.law import edge, sudden
from microslip_mechanics.contact.sliders import Sliders

BESIDE = 1e-9
"""of the way of a step: how far from the edge both sides of it are looked at"""


def jumps_of(sliders: Sliders, orbit: SampledOrbit, phase: Array) -> dict[int, Array]:
    """Return what jumps change the momentum of a small motion by, by its y [N s/m].

    Parameters
    ----------
    sliders
        The contacts, and the map from y to them.
    orbit
        How they move.
    phase
        Ends of steps over the period [rad], which touches are among.

    Returns
    -------
    By the step before which they act, each (rank, rank).
    """
    points, basis = sliders.points, sliders.basis
    abrupt = [each for each in range(points.load.size) if sudden(points, each)]
    found: dict[int, Array] = {}
    if not abrupt:
        return found
    moved, moving = orbit.at(phase)
    for point in abrupt:
        depth = moved[:, point, 0] - edge(points, point)
        for step in np.flatnonzero((depth[1:] > 0.0) != (depth[:-1] > 0.0)):
            way = abs(depth[step + 1] - depth[step])
            near = int(step) + int(abs(depth[step + 1]) < abs(depth[step]))
            velocity = moving[near, point]
            if velocity[0] == 0.0:
                continue
            jump = contact_jump(points, point, velocity, BESIDE * way)
            rows = basis[3 * point : 3 * point + 3]
            made = np.outer(rows.T @ jump, rows[0]) / abs(velocity[0])
            before = near % (phase.size - 1)
            found[before] = found.get(before, 0.0) + made
    return found
