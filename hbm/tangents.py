"""Contact tangents over the steps of a period, cut where contacts change (theory §6).

Between two samples the motion is interpolated by cubic polynomials with the velocities
at both ends. Steps begin and end where a point touches, lifts off, begins to slide,
sticks or turns. Each interval is carried in two steps with the tangents

    A₁,₂ = A₀ ∓ 4 A₁ ,    A₀ = ∫ A ds ,    A₁ = ∫ (s − ½) A ds ,    0 ≤ s ≤ 1 ,

a commutator-free Magnus method of fourth order (Blanes and Moan, 2006).
"""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from hbm.aft import AlternatingFrequencyTime
from hbm.symmetry import mirror
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.hunt_crossley import normal_force
from microslip_mechanics.contact.law import (
    FRICTIONLESS,
    ContactPoints,
    contact_force,
    normal_law,
)
from microslip_mechanics.jit import kernel

COARSE, FINE = 32, 128
"""intervals of equal length in a period without events: coarse where …"""
FEW = 64
"""… so many samples and less resolve the contacts"""
HALVINGS = 40
"""of a cell between two samples in which an event lies"""
TOUCHES, PUSHES, SLIDES = 1, 2, 4
"""bits of a point's regime"""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_INSIDE = 0.5 * (1.0 + _NODES)
# gathered at both ends, where the tangent of a contact that closes is like 1/√t
PLACES = _INSIDE**2 * (3.0 - 2.0 * _INSIDE)
MEAN = 3.0 * _WEIGHTS * _INSIDE * (1.0 - _INSIDE)
TILT = MEAN * (PLACES - 0.5)


class Path(NamedTuple):
    """The motion of the contact points at samples, for interpolation."""

    displacement: Array
    """[m], shape (3 points, samples); the last sample is where the path ends"""
    velocity: Array
    """[m/s]"""
    length: float
    """between two samples [s]"""


class StepTangents(NamedTuple):
    """Tangents that are constant during each step."""

    lengths: Array
    """[s], shape (steps,)"""
    elastic: Array
    """∂force/∂y [N/m], shape (steps, rank, rank)"""
    viscous: Array
    """∂force/∂ẏ [N s/m]"""


def step_tangents(
    contact: AlternatingFrequencyTime, basis: Array, frequency: float, *, half: bool
) -> StepTangents:
    """Return the tangents along the orbit at which ``contact`` was just called.

    Parameters
    ----------
    contact
        The contact points.
    basis
        Map from the coordinates y to the points, shape ``(3 points, rank)``.
    frequency
        Of the orbit [rad/s].
    half
        Whether only the first half of the period is wanted.
    """
    path = _path(contact, frequency, half=half)
    cells = path.displacement.shape[1] - 1
    cuts = np.concatenate([[0.0, cells], _events(contact.points, path)])
    count = COARSE if contact.samples <= FEW else FINE
    edges = _edges(np.unique(cuts), contact.samples / count)
    shape = (2 * (edges.size - 1), basis.shape[1], basis.shape[1])
    elastic, viscous = np.zeros(shape), np.zeros(shape)
    _integrate(contact.points, path, basis, edges, elastic, viscous)
    lengths = np.repeat(np.diff(edges) * path.length / 2.0, 2)
    return StepTangents(lengths, elastic, viscous)


def _path(contact: AlternatingFrequencyTime, frequency: float, *, half: bool) -> Path:
    """Return the last motion of the contact points, over a period or half of it."""
    samples, middle = contact.samples, contact.samples // 2
    rows = []
    for motion in contact.moved:
        whole, seen = np.empty((motion.shape[0], samples + 1)), motion.shape[1]
        whole[:, :seen] = motion
        if seen < samples:
            mirror(whole[:, :samples], *contact.symmetry[:2])
            # friction does not see where its tangents' mean is, and no sign fits it
            whole[:, middle:] += (motion[:, middle] - whole[:, middle])[:, None]
        whole[:, samples] = whole[:, 0]
        rows.append(np.ascontiguousarray(whole[:, : (middle if half else samples) + 1]))
    return Path(rows[0], rows[1], 2.0 * np.pi / frequency / samples)


def _edges(cuts: Array, longest: float) -> Array:
    """Return the edges of the intervals: the cuts, and equal parts between them."""
    kept = cuts[np.append(np.diff(cuts) > 1e-9 * cuts[-1], True)]
    kept[0] = 0.0
    counts = np.maximum(1, np.ceil(np.diff(kept) / longest - 0.25)).astype(int)
    parts = [
        np.linspace(left, right, count, endpoint=False)
        for (left, right), count in zip(itertools.pairwise(kept), counts, strict=True)
    ]
    return np.concatenate([*parts, kept[-1:]])


@kernel
def _place(path: Path, point: int, at: float, moved: Array, moving: Array) -> None:
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
def _regime(
    points: ContactPoints,
    point: int,
    path: Path,
    at: float,
    moved: Array,
    moving: Array,
) -> int:
    """Return which branch of its law a point is on."""
    _place(path, point, at, moved, moving)
    regime = 0
    if moved[0] > 0.0:
        force, _, _ = normal_force(normal_law(points, point), moved[0], moving[0])
        regime = TOUCHES + (PUSHES if force > 0.0 else 0)
    rubs = regime >= PUSHES or points.constant_load[point]
    if points.friction[point] != FRICTIONLESS and rubs:
        square = moving[1] * moving[1] + moving[2] * moving[2]
        if square > points.threshold[point] * points.threshold[point]:
            regime += SLIDES
    return regime


@kernel
def _slowest(path: Path, point: int, cell: int) -> float:
    """Return the share of a cell at which sliding turns, 0 if it does not."""
    row = 3 * point
    one, two = path.velocity[row + 1, cell], path.velocity[row + 2, cell]
    next_one, next_two = (
        path.velocity[row + 1, cell + 1],
        path.velocity[row + 2, cell + 1],
    )
    if one * next_one + two * next_two >= 0.0:
        return 0.0
    # where the velocity has no part along its change
    along, across = next_one - one, next_two - two
    low, high = 0.0, 1.0
    moved, moving = np.zeros(3), np.zeros(3)
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        _place(path, point, cell + middle, moved, moving)
        if moving[1] * along + moving[2] * across < 0.0:
            low = middle
        else:
            high = middle
    return high


@kernel
def _events(points: ContactPoints, path: Path) -> Array:
    """Return where a point changes its regime or turns, in samples."""
    cells = path.displacement.shape[1] - 1
    found, count = np.zeros(8 * cells * points.load.size + 1), 0
    for point in range(points.load.size):
        rubs = points.friction[point] != FRICTIONLESS
        for cell in range(cells):
            turn = _slowest(path, point, cell) if rubs else 0.0
            if turn > 0.0:
                count = _changes(points, point, path, cell, cell + turn, found, count)
                found[count] = cell + turn
                count += 1
            count = _changes(points, point, path, cell + turn, cell + 1.0, found, count)
    return found[:count]


@kernel
def _changes(
    points: ContactPoints,
    point: int,
    path: Path,
    left: float,
    right: float,
    found: Array,
    count: int,
) -> int:
    """Add the changes of regime between two places; return the number found so far."""
    moved, moving = np.zeros(3), np.zeros(3)
    before = _regime(points, point, path, left, moved, moving)
    after = _regime(points, point, path, right, moved, moving)
    for bit in (TOUCHES, PUSHES, SLIDES):
        if (before & bit) == (after & bit):
            continue
        low, high = left, right
        for _ in range(HALVINGS):
            middle = 0.5 * (low + high)
            regime = _regime(points, point, path, middle, moved, moving)
            if (regime & bit) == (before & bit):
                low = middle
            else:
                high = middle
        found[count] = high
        count += 1
    return count


@kernel
def _integrate(
    points: ContactPoints,
    path: Path,
    basis: Array,
    edges: Array,
    elastic: Array,
    viscous: Array,
) -> None:
    """Add up the tangents of both steps of each interval."""
    moved, moving, force = np.zeros(3), np.zeros(3), np.zeros(3)
    stiff, slope = np.zeros((3, 3)), np.zeros((3, 3))
    mean, tilt = np.zeros((2, 3, 3)), np.zeros((2, 3, 3))
    for interval in range(edges.size - 1):
        begin, length = edges[interval], edges[interval + 1] - edges[interval]
        for point in range(points.load.size):
            mean[:], tilt[:] = 0.0, 0.0
            for node in range(PLACES.size):
                at = begin + length * PLACES[node]
                _place(path, point, at, moved, moving)
                contact_force(points, point, moved, moving, force, stiff, slope)
                mean[0] += MEAN[node] * stiff
                mean[1] += MEAN[node] * slope
                tilt[0] += TILT[node] * stiff
                tilt[1] += TILT[node] * slope
            rows = basis[3 * point : 3 * point + 3]
            factor = _factor(mean[1], tilt[1])
            for part in range(2):
                sign = 2.0 * part - 1.0
                step = 2 * interval + part
                _add(elastic[step], rows, mean[0] + 4.0 * sign * tilt[0])
                _add(viscous[step], rows, mean[1] + factor * sign * tilt[1])


@kernel
def _factor(mean: Array, tilt: Array) -> float:
    """Return the factor of the tilt: 4, or less where damping would be negative."""
    factor = 4.0
    for axis in range(3):
        size = abs(tilt[axis, axis])
        if mean[axis, axis] > 0.0 and size * factor > mean[axis, axis]:
            factor = mean[axis, axis] / size
    return factor


@kernel
def _add(result: Array, rows: Array, tangent: Array) -> None:
    """Add rowsᵀ tangent rows."""
    for row in range(3):
        for column in range(3):
            size = tangent[row, column]
            if size == 0.0:
                continue
            for i in range(rows.shape[1]):
                if rows[row, i] == 0.0:
                    continue
                for j in range(rows.shape[1]):
                    result[i, j] += size * rows[row, i] * rows[column, j]
