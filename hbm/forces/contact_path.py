"""The motion of contact points between samples, and where their state changes (§6.1).

Between two samples the motion is interpolated by cubic polynomials with the velocities
at both ends.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.symmetry import mirror
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import edge, regularised
from microslip_mechanics.contact.normal import normal_response
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel, inner_kernel, kernel

HALVINGS = 40
"""of a cell between two samples in which an event lies"""
TOUCHES, PUSHES, SLIDES = 1, 2, 4
"""bits of a point's regime"""


class ContactPath(NamedTuple):
    """The motion of the contact points at samples, for interpolation."""

    displacement: Array
    """[m], shape (3 points, samples); the last sample is where the path ends"""
    velocity: Array
    """[m/s]"""
    length: float
    """between two samples [s]"""


def last_path(
    contact: AlternatingFrequencyTime, frequency: float, *, half: bool
) -> ContactPath:
    """Return the last motion of the contact points, over a period or half of it."""
    samples, middle = contact.samples, contact.samples // 2
    rows = []
    for motion in contact.moved:
        whole, seen = np.empty((motion.shape[0], samples + 1)), motion.shape[1]
        whole[:, :seen] = motion
        if seen < samples:
            mirror(whole[:, :samples], *contact.symmetry[:2])
            # friction does not see where its tangents' mean is, and no sign fits it
            whole[:, middle:samples] += (motion[:, middle] - whole[:, middle])[:, None]
        whole[:, samples] = whole[:, 0]
        rows.append(np.ascontiguousarray(whole[:, : (middle if half else samples) + 1]))
    return ContactPath(rows[0], rows[1], 2.0 * np.pi / frequency / samples)


@bare_kernel
def place(
    path: ContactPath, point: int, at: float, moved: Array, moving: Array
) -> None:
    """Write displacement and velocity of a point ``at`` samples after the first."""
    cell = min(int(at), path.displacement.shape[1] - 2)
    share, length = at - cell, path.length
    rest = 1.0 - share
    for axis in range(3):
        row = 3 * point + axis
        first, last = path.displacement[row, cell], path.displacement[row, cell + 1]
        left, right = path.velocity[row, cell], path.velocity[row, cell + 1]
        bump = share * rest
        moved[axis] = (
            first * rest * rest * (1.0 + 2.0 * share)
            + last * share * share * (1.0 + 2.0 * rest)
            + length * bump * (left * rest - right * share)
        )
        mean = (last - first) / length
        moving[axis] = (
            left * rest + right * share + 3.0 * bump * (2.0 * mean - left - right)
        )


@kernel
def events(points: ContactPoints, path: ContactPath) -> Array:
    """Return where a point changes its regime or turns, in samples."""
    cells = path.displacement.shape[1] - 1
    found = np.empty(7 * points.load.size * cells)
    work = np.zeros((2, 3))
    count = int(0.0)  # kernels are compiled anew for a literal
    for point in range(points.load.size):
        before = _regime(points, point, path, 0.0, work)
        for cell in range(cells):
            after = _regime(points, point, path, cell + 1.0, work)
            turn = 0.0
            if regularised(points, point):
                turn = _slowest(path, point, cell, work)
            left = float(cell)
            if turn > 0.0:
                middle = _regime(points, point, path, cell + turn, work)
                count = _changes(
                    points, point, path, left, cell + turn, before, middle, work,
                    found, count,
                )  # fmt: skip
                left, before = cell + turn, middle
                found[count] = left
                count += 1
            if after != before:
                count = _changes(
                    points, point, path, left, cell + 1.0, before, after, work,
                    found, count,
                )  # fmt: skip
            before = after
    return found[:count]


@inner_kernel
def _regime(
    points: ContactPoints, point: int, path: ContactPath, at: float, work: Array
) -> int:
    """Return which branch of its law a point is on."""
    moved, moving = work[0], work[1]
    place(path, point, at, moved, moving)
    regime = 0
    if moved[0] > edge(points, point):
        force, _, _ = normal_response(points, point, moved[0], moving[0])
        regime = TOUCHES + (PUSHES if force > 0.0 else 0)
    loaded = regime >= PUSHES or points.constant_load[point]
    if loaded and regularised(points, point):
        square = moving[1] * moving[1] + moving[2] * moving[2]
        if square > points.threshold[point] * points.threshold[point]:
            regime += SLIDES
    return regime


@inner_kernel
def _slowest(path: ContactPath, point: int, cell: int, work: Array) -> float:
    """Return the share of a cell at which sliding turns, 0 if it does not."""
    velocity, row = path.velocity, 3 * point
    one, two = velocity[row + 1, cell], velocity[row + 2, cell]
    next_one, next_two = velocity[row + 1, cell + 1], velocity[row + 2, cell + 1]
    if one * next_one + two * next_two >= 0.0:
        return 0.0
    # where the velocity has no part along its change
    along, across = next_one - one, next_two - two
    low, high = 0.0, 1.0
    moved, moving = work[0], work[1]
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        place(path, point, cell + middle, moved, moving)
        if moving[1] * along + moving[2] * across < 0.0:
            low = middle
        else:
            high = middle
    return high


@inner_kernel
def _changes(
    points: ContactPoints,
    point: int,
    path: ContactPath,
    left: float,
    right: float,
    before: int,
    after: int,
    work: Array,
    found: Array,
    count: int,
) -> int:
    """Add the changes of regime between two places; return the number found so far."""
    for bit in (TOUCHES, PUSHES, SLIDES):
        if (before & bit) == (after & bit):
            continue
        low, high = left, right
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            regime = _regime(points, point, path, middle, work)
            if (regime & bit) == (before & bit):
                low = middle
            else:
                high = middle
        found[count] = high
        count += 1
    return count
