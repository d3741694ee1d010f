"""Contact tangents over the steps of a period, cut where contacts change (theory §6.4).

Steps begin and end where a point touches, lifts off, begins to slide, sticks or turns.
A force that jumps there is a step of next to no length, as stiff as its jump over the
speed asks. Each interval is carried in two steps with the tangents

    A₁,₂ = A₀ ∓ 4 A₁ ,    A₀ = ∫ A ds ,    A₁ = ∫ (s − ½) A ds ,    0 ≤ s ≤ 1 ,

a commutator-free Magnus method of fourth order (Blanes and Moan, 2006). An interval is
halved until A changes in it by little beside the inertia of its points, and until what
touches briefly vibrates in it by a small part of its own period.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.contact_path import ContactPath, events, last_path
from hbm.stability.brief_touches import touched_times
from hbm.stability.tangent_jumps import add_jump
from hbm.stability.tangent_moments import (
    add_steps,
    caught,
    largest_change,
    largest_phase,
    write_moments,
)
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel

COARSE, FINE = 48, 96
"""intervals of a period at least: coarse where …"""
FEW = 64
"""… so many samples and less resolve the contacts"""
CHANGE = 0.1
"""of the tangents in an interval, from which it is halved"""
BRIEF = 1.0 / 256.0
"""of a period: first interval of a point that sticks"""
SHORTEST = 1.0 / 2048.0
"""of a period: what is shorter is not halved for that"""
PHASE = 0.5
"""angle by which a point that touches briefly may vibrate in an interval [rad]"""


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
    changes = np.empty(0) if contact.smooth else events(contact.points, path)
    cuts = np.concatenate([ends, changes])
    fewest = COARSE if contact.samples <= FEW else FINE
    edges = _edges(np.unique(cuts), contact.samples / fewest)
    shortest = contact.samples * SHORTEST
    touched = touched_times(contact, path, half=half)
    return StepTangents(
        *_integrated(contact.points, path, basis, inertia, touched, edges, shortest)
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
    path: ContactPath,
    basis: Array,
    inertia: Array,
    touched: Array,
    edges: Array,
    shortest: float,
) -> tuple[Array, Array, Array, NDArray[np.bool_]]:
    """Return what :class:`StepTangents` has."""
    rank, count = basis.shape[1], int(0.0)  # kernels are compiled anew for a literal
    room = 8 * edges.size + 64
    lengths, sticks = np.empty(room), np.zeros(room, dtype=np.bool_)
    elastic: Array = np.zeros((room, rank, rank))
    viscous: Array = np.zeros((room, rank, rank))
    moments = np.zeros((points.load.size, 3, 2, 3, 3))
    ends, held = np.empty(64), np.zeros(inertia.size, dtype=np.bool_)
    # what is held at the beginning has been caught before
    write_moments(points, path, edges[0], edges[1] - edges[0], moments)
    caught(moments, inertia, BRIEF / SHORTEST * shortest * path.length, held)
    for interval in range(edges.size - 1):
        count = add_jump(points, path, edges[interval], basis, elastic, lengths, count)
        begin, waiting = edges[interval], 1
        ends[0] = edges[interval + 1]
        while waiting > 0:
            length = ends[waiting - 1] - begin
            write_moments(points, path, begin, length, moments)
            taken, begins = _taken(
                moments, inertia, touched, length, shortest, path.length, held
            )
            if taken < length:
                ends[waiting] = begin + taken
                waiting += 1
                continue
            if count + 2 > lengths.size:
                elastic, viscous = _longer(elastic), _longer(viscous)
                lengths = np.append(lengths, lengths)
                sticks = np.append(sticks, sticks)
            add_steps(moments, basis, elastic, viscous, count)
            lengths[count : count + 2] = 0.5 * length * path.length
            sticks[count : count + 2] = begins
            begin, waiting, count = ends[waiting - 1], waiting - 1, count + 2
    return lengths[:count], elastic[:count], viscous[:count], sticks[:count]


@kernel
def _taken(
    moments: Array,
    inertia: Array,
    touched: Array,
    length: float,
    shortest: float,
    sample: float,
    held: NDArray[np.bool_],
) -> tuple[float, bool]:
    """Return how much of an interval is taken, and whether a point sticks in it.

    ``sample`` is the time between two samples; ``held`` is brought up to date if all is
    taken.
    """
    changes = largest_change(moments, inertia, length * sample) > CHANGE
    turns = largest_phase(moments, inertia, touched, length * sample) > PHASE
    if turns or (changes and length > 2.0 * shortest):
        return 0.5 * length, False
    brief = BRIEF / SHORTEST * shortest
    before = held.copy()
    begins = caught(moments, inertia, brief * sample, held)
    if begins and length > 1.5 * brief:
        for row in range(held.size):
            held[row] = before[row]
        return brief, False
    return length, begins


@kernel
def _longer(steps: Array) -> Array:
    """Return the same with as much room again."""
    result: Array = np.zeros((2 * steps.shape[0], steps.shape[1], steps.shape[2]))
    for step in range(steps.shape[0]):
        for row in range(steps.shape[1]):
            for column in range(steps.shape[2]):
                result[step, row, column] = steps[step, row, column]
    return result
