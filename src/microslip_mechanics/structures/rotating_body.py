"""A rigid body in rotating axes (theory §9)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.rigid_body import point_motion
from microslip_mechanics.structures.rotating_part import RotatingPart
from microslip_mechanics.structures.rotation import cross


def rotating_body(
    mass: float, inertia: Array, offset: Array, spin: Array, centre: Array
) -> RotatingPart:
    """Return load, softening and Coriolis matrix of a rigid body about a node.

    Parameters
    ----------
    mass, inertia, offset
        As :func:`~microslip_mechanics.structures.rigid_body.rigid_mass` takes them.
    spin
        W, the cross product with Ω [rad/s], shape ``(3, 3)``.
    centre
        Centre of mass minus a point of the axis of rotation [m], shape ``(3,)``.

    Notes
    -----
    From the potential −½ ∫ |Ω × p|² dm up to second order in displacement and rotation
    vector: what pulls outwards beyond the node holds the body against turning.
    """
    motion, square = point_motion(offset), spin @ spin
    force = -mass * square @ centre
    load, softening = motion.T @ force, mass * motion.T @ square @ motion
    coriolis = 2.0 * mass * motion.T @ spin @ motion
    lever = np.outer(force, offset)
    softening[3:, 3:] += np.trace(lever) * np.eye(3) - (lever + lever.T) / 2.0
    spread = np.trace(inertia) / 2.0 * np.eye(3) - inertia
    sizes, directions = np.linalg.eigh(spread)
    for size, direction in zip(sizes, directions.T, strict=True):
        arm = cross(direction)
        load[3:] -= size * arm @ square @ direction
        softening[3:, 3:] += size * arm.T @ square @ arm
        coriolis[3:, 3:] += 2.0 * size * arm.T @ spin @ arm
    pressed = square @ spread
    softening[3:, 3:] += (pressed + pressed.T) / 2.0 - np.trace(pressed) * np.eye(3)
    return RotatingPart(load, softening, coriolis)
