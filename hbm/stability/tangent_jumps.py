"""Steps of next to no length in which contact forces jump (theory §8)."""

from __future__ import annotations

import numpy as np

from hbm.forces.contact_path import ContactPath, place
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force, edge, sudden
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel

SUDDEN = 1e-9
"""of a sample: length of the step in which a force jumps"""
BESIDE = 1e-5
"""of a sample: how far from an edge of intervals both sides are looked at"""


@kernel
def add_jump(
    points: ContactPoints,
    path: ContactPath,
    at: float,
    basis: Array,
    elastic: Array,
    lengths: Array,
    count: int,
) -> int:
    """Add a step if forces jump where points touch or part; return the steps so far.

    The moment of the jump moves by −δw/ẇ with the normal motion w, so that it changes
    the momentum like a stiffness of jump/|ẇ| that acts at that moment alone.
    """
    if count == 0 or count == lengths.size:
        return count
    length, found = SUDDEN * path.length, False
    jump, work = np.zeros(3), np.zeros((4, 3))
    for point in range(points.load.size):
        if not (sudden(points, point) and _jump(points, point, path, at, work, jump)):
            continue
        found = True
        for row in range(basis.shape[1]):
            push = 0.0
            for axis in range(3):
                push += basis[3 * point + axis, row] * jump[axis] / length
            for column in range(basis.shape[1]):
                elastic[count, row, column] += push * basis[3 * point, column]
    lengths[count] = length if found else lengths[count]
    return count + (1 if found else 0)


@kernel
def _jump(
    points: ContactPoints,
    point: int,
    path: ContactPath,
    at: float,
    work: Array,
    jump: Array,
) -> bool:
    """Write the jump of a point's force as it closes, over its normal speed [N s/m].

    Return whether it touches or parts there.
    """
    moved, moving = work[0], work[1]
    tangents = np.zeros((2, 3, 3))
    jump[:] = 0.0
    speed, pressed = 0.0, 0
    for side in (-1.0, 1.0):
        place(path, point, at + side * BESIDE, moved, moving)
        contact_force(points, point, moved, moving, work[2], tangents[0], tangents[1])
        inside = moved[0] > edge(points, point)
        pressed += 1 if inside else 0
        speed += 0.5 * abs(moving[0])
        for axis in range(3):
            jump[axis] += work[2, axis] if inside else -work[2, axis]
    if pressed != 1 or speed == 0.0:
        return False
    jump /= speed
    return True
