"""How far and how fast a motion goes, between the rows of its history too."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

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
    more than ``dense`` [rad]. Its velocity counts where the rows' velocities bend like
    it, not across impacts.
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
            _bends(velocity, rows)[:, known],
        )
        found[:, known] = np.maximum(found[:, known], turned)
    return found


def halves(time: Array, displacement: Array, velocity: Array) -> Array:
    """Return what :func:`largest` finds with every second row, (2, 2, probes)."""
    found = [
        largest(time[rows], displacement[rows], velocity[rows], dense=2.0 * DENSE)
        for rows in (slice(0, None, 2), slice(min(1, len(time) - 1), None, 2))
    ]
    return np.array(found)


def bent(values: Array) -> Array:
    """Return least and largest of what may lie between rows, shape ``(2, values)``.

    Beyond an extreme at a row a parabola goes on by no more than an eighth of what the
    rows bend by there. What never is negative is not so between the rows either.
    """
    low, high = values.min(axis=0), values.max(axis=0)
    if len(values) > 2:
        beyond = values[1:-1] - np.diff(values, 2, axis=0) / 8.0
        low = np.where(low < 0.0, np.minimum(low, beyond.min(axis=0)), low)
        high = np.maximum(high, beyond.max(axis=0))
    return np.stack([low, high])


def _bends(velocity: Array, rows: slice) -> Array:
    """Return by what velocities bend at rows; they stay beyond the first and last."""
    around = np.arange(rows.start - 1, min(rows.stop, len(velocity)) + 1)
    return np.diff(velocity[around.clip(0, len(velocity) - 1)], 2, axis=0)


def _cubics(
    step: Array, displacement: Array, velocity: Array, bends: Array
) -> tuple[Array, Array]:
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
    inside = (bend > 0.0) & (bend < 1.0) & _alike(3.0 * cube / step, bends)
    at = np.where(inside, bend, 0.0)
    fast = (rise + at * (2.0 * square + 3.0 * at * cube)) / step
    return np.abs(far).max(axis=(0, 1)), np.abs(fast).max(axis=0)


def _alike(curved: Array, bends: Array) -> NDArray[np.bool_]:
    """Return where parabolas of velocity curve no more than both of their rows bend."""
    before = bends[:-1] * np.sign(curved)
    after = bends[1:] * np.sign(curved)
    alike: NDArray[np.bool_] = np.minimum(before, after) >= np.abs(curved)
    return alike
