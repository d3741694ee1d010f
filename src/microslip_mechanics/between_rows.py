"""How far and how fast a motion goes, between the rows of its history too."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array

DENSE = 1.0
"""most that the phase may turn from row to row [rad]: sparser rows say nothing of what
lies between them"""
BLOCK = 10**5
"""rows that are looked at together: long histories leave little memory"""


def largest(
    time: Array, displacement: Array, velocity: Array, *, dense: float = DENSE
) -> Array:
    """Return the largest displacement [m] and velocity [m/s], shape ``(2, probes)``.

    Between two rows, whose displacements and velocities have the shape
    ``(rows, probes)``, goes the cubic that has those of both, if the phase turns by no
    more than ``dense`` [rad].
    """
    found = np.stack([np.abs(displacement).max(axis=0), np.abs(velocity).max(axis=0)])
    half = 0.5 * np.ptp(displacement, axis=0)
    known = np.diff(time).max(initial=0.0) * found[1] <= dense * half
    for start in range(0, len(time) - 1 if known.any() else 0, BLOCK):
        rows = slice(start, start + BLOCK + 1)
        turned = _cubics(
            np.diff(time[rows])[:, None],
            displacement[rows, known],
            velocity[rows, known],
        )
        found[:, known] = np.maximum(found[:, known], turned)
    return found


def rows_error(time: Array, displacement: Array, velocity: Array) -> float:
    """Return about the largest error of a largest displacement, over the largest.

    It is what half of the rows change, the worse ones: far more than all rows err by
    if they are dense.
    """
    far, _ = largest(time, displacement, velocity)
    half = [
        largest(time[rows], displacement[rows], velocity[rows], dense=2.0 * DENSE)[0]
        for rows in (slice(0, None, 2), slice(1, None, 2))
        if len(time[rows])
    ]
    away = np.abs(np.array(half) - far).max(initial=0.0)
    return float(away / (far.max(initial=0.0) or 1.0))


def _cubics(step: Array, displacement: Array, velocity: Array) -> tuple[Array, Array]:
    """Return the largest values where the cubics turn, each of shape ``(probes,)``."""
    before, rise = displacement[:-1], step * velocity[:-1]
    change = np.diff(displacement, axis=0)
    cube = rise + step * velocity[1:] - 2.0 * change
    square = change - rise - cube
    # the derivative rise + 2 square u + 3 cube u² has one root between unlike signs
    turns = velocity[:-1] * velocity[1:] < 0.0
    root = np.sqrt(np.maximum(square**2 - 3.0 * cube * rise, 0.0))
    weight = -(square + np.copysign(root, square))
    with np.errstate(divide="ignore", invalid="ignore"):
        roots = np.stack([rise / weight, weight / (3.0 * cube)])
        bend = -square / (3.0 * cube)
    inside = turns & (roots >= 0.0) & (roots <= 1.0)
    at = np.where(inside, roots, 0.0)
    far = before + at * (rise + at * (square + at * cube))
    at = np.where((bend > 0.0) & (bend < 1.0), bend, 0.0)
    fast = (rise + at * (2.0 * square + 3.0 * at * cube)) / step
    return np.abs(far).max(axis=(0, 1)), np.abs(fast).max(axis=0)
