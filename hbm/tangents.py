"""Contact tangents over the steps of a period, cut where contacts change (theory §6).

Steps begin and end where a point touches, lifts off, begins to slide, sticks or turns.
A force that jumps there is a step of next to no length, as stiff as its jump over the
speed asks. Each interval is carried in two steps with the tangents

    A₁,₂ = A₀ ∓ 4 A₁ ,    A₀ = ∫ A ds ,    A₁ = ∫ (s − ½) A ds ,    0 ≤ s ≤ 1 ,

a commutator-free Magnus method of fourth order (Blanes and Moan, 2006). An interval is
halved until A changes in it by little beside the inertia of its points.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.aft import AlternatingFrequencyTime
from hbm.contact_path import Path, events, last_path, place
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import ContactPoints, contact_force, edge
from microslip_mechanics.jit import bare_kernel, kernel

COARSE, FINE = 48, 96
"""intervals of a period at least: coarse where …"""
FEW = 64
"""… so many samples and less resolve the contacts"""
CHANGE = 0.1
"""of the tangents in an interval, from which it is halved"""
BRIEF = 1.0 / 256.0
"""of a period: first interval of a point that sticks"""
STIFF = 1.0
"""damping of a point that sticks, times :data:`BRIEF`, over its inertia"""
SHORTEST = 1.0 / 2048.0
"""of a period: what is shorter is not halved"""

SUDDEN = 1e-9
"""of a sample: length of the step in which a force jumps"""
BESIDE = 1e-5
"""of a sample: how far from an edge of intervals both sides are looked at"""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_INSIDE = 0.5 * (1.0 + _NODES)
# gathered at both ends, where the tangent of a contact that closes is like 1/√t
PLACES = _INSIDE**2 * (3.0 - 2.0 * _INSIDE)
MEAN = 3.0 * _WEIGHTS * _INSIDE * (1.0 - _INSIDE)
TILT = MEAN * (PLACES - 0.5)
BEND = MEAN * (6.0 * (PLACES - 0.5) ** 2 - 0.5)
"""weights of A₀, of A₁, and of what a straight line leaves of A"""


class StepTangents(NamedTuple):
    """Tangents that are constant during each step."""

    lengths: Array
    """[s], shape (steps,)"""
    elastic: Array
    """∂force/∂y [N/m], shape (steps, rank, rank)"""
    viscous: Array
    """∂force/∂ẏ [N s/m]"""
    sticks: NDArray[np.bool_]
    """whether a point was set free of damping before, and is held by it now"""


def step_tangents(
    contact: AlternatingFrequencyTime,
    basis: Array,
    inertia: Array,
    frequency: float,
    *,
    half: bool,
) -> StepTangents:
    """Return the tangents along the orbit at which ``contact`` was just called.

    Parameters
    ----------
    contact
        The contact points.
    basis
        Map from the coordinates y to the points, shape ``(3 points, rank)``.
    inertia
        What a sudden force on a point moves [kg], shape ``(3 points,)``.
    frequency
        Of the orbit [rad/s].
    half
        Whether only the first half of the period is wanted.
    """
    path = last_path(contact, frequency, half=half)
    cells = path.displacement.shape[1] - 1
    # half a period has the steps that it has in a whole one
    ends = [0.0, contact.samples // 2, cells]
    cuts = np.concatenate([ends, events(contact.points, path)])
    fewest = COARSE if contact.samples <= FEW else FINE
    edges = _edges(np.unique(cuts), contact.samples / fewest)
    shortest = contact.samples * SHORTEST
    return StepTangents(
        *_integrated(contact.points, path, basis, inertia, edges, shortest, CHANGE)
    )


def _edges(cuts: Array, longest: float) -> Array:
    """Return the edges of the intervals: the cuts, and equal parts between them."""
    kept = cuts[np.append(np.diff(cuts) > 1e-9 * cuts[-1], True)]
    kept[0] = 0.0
    gaps = np.diff(kept)
    counts = np.maximum(1, np.ceil(gaps / longest - 0.25)).astype(int)
    firsts = np.cumsum(counts) - counts
    parts = np.arange(counts.sum()) - firsts.repeat(counts)
    edges = kept[:-1].repeat(counts) + parts * (gaps / counts).repeat(counts)
    return np.append(edges, kept[-1])


@kernel
def _integrated(
    points: ContactPoints,
    path: Path,
    basis: Array,
    inertia: Array,
    edges: Array,
    shortest: float,
    allowed: float,
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Return what :class:`StepTangents` has."""
    rank, count = basis.shape[1], 0
    room = 8 * edges.size + 64
    lengths, sticks = np.empty(room), np.zeros(room, dtype=np.bool_)
    elastic: Array = np.zeros((room, rank, rank))
    viscous: Array = np.zeros((room, rank, rank))
    moments = np.zeros((points.load.size, 3, 2, 3, 3))
    ends, held = np.empty(64), np.zeros(inertia.size, dtype=np.bool_)
    # what is held at the beginning has been caught before
    _moments(points, path, edges[0], edges[1] - edges[0], moments)
    _catches(moments, inertia, BRIEF / SHORTEST * shortest * path.length, held)
    for interval in range(edges.size - 1):
        count = _jumps(points, path, edges[interval], basis, elastic, lengths, count)
        begin, waiting = edges[interval], 1
        ends[0] = edges[interval + 1]
        while waiting > 0:
            length = ends[waiting - 1] - begin
            _moments(points, path, begin, length, moments)
            taken, begins = _taken(
                moments, inertia, length, shortest, path.length, allowed, held
            )
            if taken < length:
                ends[waiting] = begin + taken
                waiting += 1
                continue
            if count + 2 > lengths.size:
                elastic, viscous = _longer(elastic), _longer(viscous)
                lengths = np.append(lengths, lengths)
                sticks = np.append(sticks, sticks)
            _add_steps(moments, basis, elastic, viscous, count)
            lengths[count : count + 2] = 0.5 * length * path.length
            sticks[count : count + 2] = begins
            begin, waiting, count = ends[waiting - 1], waiting - 1, count + 2
    return lengths[:count], elastic[:count], viscous[:count], sticks[:count]


@kernel
def _jumps(
    points: ContactPoints,
    path: Path,
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
        if points.damping[point] == 0.0 or not _jump(
            points, point, path, at, work, jump
        ):
            continue
        found = True
        rows = basis[3 * point : 3 * point + 3]
        elastic[count] += np.outer(np.dot(rows.T, jump / length), rows[0])
    lengths[count] = length if found else lengths[count]
    return count + (1 if found else 0)


@kernel
def _jump(
    points: ContactPoints, point: int, path: Path, at: float, work: Array, jump: Array
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


@kernel
def _taken(
    moments: Array,
    inertia: Array,
    length: float,
    shortest: float,
    sample: float,
    allowed: float,
    held: NDArray[np.bool_],
) -> tuple[float, bool]:
    """Return how much of an interval is taken, and whether a point sticks in it.

    ``sample`` is the time between two samples; ``held`` is brought up to date if all is
    taken.
    """
    changes = _change(moments, inertia, length * sample) > allowed
    if changes and length > 2.0 * shortest:
        return 0.5 * length, False
    brief = BRIEF / SHORTEST * shortest
    before = held.copy()
    begins = _catches(moments, inertia, brief * sample, held)
    if begins and length > 1.5 * brief:
        held[:] = before
        return brief, False
    return length, begins


@kernel
def _longer(steps: Array) -> Array:
    """Return the same with as much room again."""
    result: Array = np.zeros((2 * steps.shape[0], steps.shape[1], steps.shape[2]))
    result[: steps.shape[0]] = steps
    return result


@kernel
def _moments(
    points: ContactPoints, path: Path, begin: float, length: float, moments: Array
) -> None:
    """Write mean, tilt and bend of the tangents of each point in an interval.

    ``moments`` has shape ``(points, 3, 2, 3, 3)``: the last are those by displacement
    and those by velocity.
    """
    moved, moving, force = np.zeros(3), np.zeros(3), np.zeros(3)
    tangents = np.zeros((2, 3, 3))
    moments[:] = 0.0
    for point in range(points.load.size):
        for node in range(PLACES.size):
            at = begin + length * PLACES[node]
            place(path, point, at, moved, moving)
            contact_force(points, point, moved, moving, force, tangents[0], tangents[1])
            for kind in range(2):
                for row in range(3):
                    for column in range(3):
                        size = tangents[kind, row, column]
                        moments[point, 0, kind, row, column] += MEAN[node] * size
                        moments[point, 1, kind, row, column] += TILT[node] * size
                        moments[point, 2, kind, row, column] += BEND[node] * size


@bare_kernel
def _change(moments: Array, inertia: Array, length: float) -> float:
    """Return by how much the tangents of a point change, beside what holds it."""
    largest = 0.0
    for point in range(moments.shape[0]):
        for row in range(3):
            held, change = inertia[3 * point + row], 0.0
            for kind, scale in ((0, length * length), (1, length)):
                held += scale * abs(moments[point, 0, kind, row, row])
                for column in range(3):
                    change += scale * (
                        abs(moments[point, 1, kind, row, column])
                        + abs(moments[point, 2, kind, row, column])
                    )
            largest = max(largest, change / held)
    return largest


@bare_kernel
def _catches(
    moments: Array,
    inertia: Array,
    brief: float,
    held: NDArray[np.bool_],
) -> bool:
    """Write which points damping holds; return whether one was not held before."""
    begins = False
    for point in range(moments.shape[0]):
        for axis in range(3):
            row = 3 * point + axis
            damping = brief * moments[point, 0, 1, axis, axis]
            catches = damping > STIFF * inertia[row]
            begins = begins or (catches and not held[row])
            held[row] = catches
    return begins


@bare_kernel
def _add_steps(
    moments: Array, basis: Array, elastic: Array, viscous: Array, step: int
) -> None:
    """Add up the tangents of all points in both steps of an interval."""
    for point in range(moments.shape[0]):
        rows = basis[3 * point : 3 * point + 3]
        mean, tilt = moments[point, 0], moments[point, 1]
        factor = _factor(mean[1], tilt[1])
        for part in range(2):
            sign = 2.0 * part - 1.0
            _add(elastic[step + part], rows, mean[0], tilt[0], 4.0 * sign)
            _add(viscous[step + part], rows, mean[1], tilt[1], factor * sign)


@bare_kernel
def _factor(mean: Array, tilt: Array) -> float:
    """Return the factor of the tilt: 4, or less where damping would be negative."""
    factor = 4.0
    for axis in range(3):
        size = abs(tilt[axis, axis])
        if mean[axis, axis] > 0.0 and size * factor > mean[axis, axis]:
            factor = mean[axis, axis] / size
    return factor


@bare_kernel
def _add(result: Array, rows: Array, mean: Array, tilt: Array, factor: float) -> None:
    """Add rowsᵀ (mean + factor tilt) rows."""
    for row in range(3):
        for column in range(3):
            size = mean[row, column] + factor * tilt[row, column]
            if size == 0.0:
                continue
            for i in range(rows.shape[1]):
                if rows[row, i] == 0.0:
                    continue
                for j in range(rows.shape[1]):
                    result[i, j] += size * rows[row, i] * rows[column, j]
