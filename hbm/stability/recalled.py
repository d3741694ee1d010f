"""Floquet multipliers where contacts remember (theory §6.5).

The tractions T of friction that remembers are carried beside a small motion. Structure
and mean tangents are one constant matrix A, diagonal in its own motions; what contacts
add is held constant over a step,

    f = (T₀ + T₁)/2 + K' (y₀ + y₁)/2 + C' (y₁ − y₀)/h ,

of second order in the steps; T₁ follows from motion and T₀ as along the orbit. A force
that jumps as faces touch acts at once, between two steps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.contact_path import events, last_path
from hbm.forces.sampled_orbit import SampledOrbit
from hbm.stability.brief_touches import touched_times, vibration, within_touches
from hbm.stability.jumps import jumps_of
from hbm.stability.mean_motions import (
    MeanMotions,
    free_steps,
    mean_motions,
    stacked,
    turned,
)
from hbm.stability.slide_events import SlidOrbit, slid_orbit
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.contact.law import regularised
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.tangents import contact_tangents
from microslip_mechanics.results.response import MARGIN

TURN = 2.0 * np.pi
STEPS, MOST = 256, 4096
"""of a period at first and at most, without those that events add"""
FINER = 4
"""times as many steps are taken next, while an orbit seems unstable"""
ALIKE = 1e-2
"""of the largest multiplier, by which that may change where steps are enough"""
LEAST = 0.05
"""share of the period in which a slider is taken to stick in the mean, at least"""


def recalled_multipliers(
    matrices: tuple[Array, Array, Array],
    basis: Array,
    inertia: Array,
    contact: AlternatingFrequencyTime,
    frequency: float,
) -> ComplexArray:
    """Return the multipliers of motion and tractions, the largest modulus first.

    Steps too long for the fastest motions make those unstable: an orbit that seems so
    is looked at with finer ones.

    Parameters
    ----------
    matrices
        Mass, damping and stiffness, each (coordinates, coordinates), y first.
    basis
        Map from y to the contact points, shape (3 points, rank).
    inertia
        What a sudden force on a contact point moves [kg], shape (3 points,).
    contact
        Just called at the orbit.
    frequency
        Of the orbit [rad/s].

    Returns
    -------
    Those of sliders that never slip, exactly one, are left out. None if they cannot be
    known: regularised friction beside what remembers turns over too fast for equal
    steps, and a body that nothing holds has no motions of its own.
    """
    steps, given = STEPS, (matrices, basis, inertia, contact, frequency)
    known = _of_steps(*given, steps)
    while steps < MOST and np.abs(known).max(initial=0.0) > 1.0 + MARGIN:
        steps, before = FINER * steps, np.abs(known[0])
        known = _of_steps(*given, steps)
        if abs(np.abs(known[0]) - before) <= ALIKE * before:
            break
    return known


def _of_steps(
    matrices: tuple[Array, Array, Array],
    basis: Array,
    inertia: Array,
    contact: AlternatingFrequencyTime,
    frequency: float,
    steps: int,
) -> ComplexArray:
    """Return the multipliers by so many steps of a period."""
    points = contact.points
    if any(regularised(points, point) for point in range(points.load.size)):
        return np.empty(0, complex)
    sliders = Sliders.of(points, basis, contact.floating)
    orbit = SampledOrbit.of(contact, frequency)
    path = last_path(contact, frequency, half=False)
    pressed = TURN / contact.samples * events(points, path)
    brief = touched_times(contact, path, half=False), inertia[::3]
    among = within_touches(points, orbit, pressed, *brief)
    slid = slid_orbit(sliders, orbit, among, steps)
    middle = 0.5 * (slid.phase[1:] + slid.phase[:-1])
    elastic, viscous = contact_tangents(points, basis, *orbit.at(middle))
    share = np.diff(slid.phase) / TURN
    apart = vibration(points, orbit, middle, *brief) == 0.0
    if apart.any():  # tangents of touches are far from any mean
        share = np.where(apart, share, 0.0) / share[apart].sum()
    held = np.tensordot(share, elastic, axes=1) + _springs(sliders, slid, share)
    drag = np.tensordot(share, viscous, axes=1)
    motions = mean_motions(matrices, held, drag, frequency)
    if motions is None:
        return np.empty(0, complex)
    changes = _Changes(
        elastic - held, viscous - drag, jumps_of(sliders, orbit, slid.phase)
    )
    carried = _carried(motions, sliders, slid, changes, frequency)
    values = np.linalg.eigvals(_loose(carried, sliders, slid)).astype(complex)
    ordered: ComplexArray = values[np.argsort(-np.abs(values))]
    return ordered


def _springs(sliders: Sliders, slid: SlidOrbit, share: Array) -> Array:
    """Return the stiffness of all sliders while they stick, as a mean of the period.

    At least :data:`LEAST` of it, which holds what nothing else does.
    """
    along = sliders.along
    sticks = np.einsum("tsr,sr->ts", slid.slides.past[1:, :, : along.shape[1]], along)
    sticks /= sliders.stiffness * (along**2).sum(axis=1)
    mean = np.clip(share @ sticks, LEAST, 1.0)
    made: Array = along.T @ ((mean * sliders.stiffness)[:, None] * along)
    return made


@dataclass(frozen=True, slots=True)
class _Changes:
    """What contacts do beside their mean tangents."""

    elastic: Array
    """tangents during each step less the means, each (steps, rank, rank)"""
    viscous: Array
    jumps: dict[int, Array]
    """change of momentum by y before a step, each (rank, rank)"""


def _carried(
    motions: MeanMotions,
    sliders: Sliders,
    slid: SlidOrbit,
    changes: _Changes,
    frequency: float,
) -> Array:
    """Return the map of (x, T) over the period, shape (states, states)."""
    lengths = np.diff(slid.phase)
    step = free_steps(motions, lengths, frequency)
    past, ahead = _answers(sliders, slid, changes, lengths / frequency)
    rank, (count, size) = motions.push.shape[1], motions.parts.shape
    inverse = np.linalg.inv(np.eye(rank) + ahead @ step.felt[step.kind])
    slides, pull = slid.slides, 0.5 * sliders.along.T
    # real parts above imaginary ones: products with real matrices are cheaper
    seen, shapes = stacked(motions.seen), stacked(motions.shapes)
    kick = np.vstack([motions.push.real, motions.push.imag])
    whole = np.eye(size + sliders.count)
    state: Array = np.vstack([motions.parts.real, motions.parts.imag]) @ whole[:size]
    held: Array = whole[size:]
    watched: Array = seen @ state
    for place, kind in enumerate(step.kind):
        if place in changes.jumps:
            state = state - kick @ (changes.jumps[place] @ watched[:rank])
            watched = seen @ state
        memory = slides.traction_past[place + 1] @ held
        memory -= slides.past[place + 1] @ watched
        state = turned(step.turn[kind], state[:count], state[count:])
        moved = seen @ state
        known = past[place] @ watched[:rank] + pull @ (held + memory)
        force = inverse[place] @ (known + ahead[place] @ moved)
        state -= step.kicks[kind] @ force
        watched = moved - step.felt[kind] @ force
        held = memory + slides.motion[place + 1] @ watched
    return np.vstack([shapes @ state, held])


def _answers(
    sliders: Sliders, slid: SlidOrbit, changes: _Changes, lengths: Array
) -> tuple[Array, Array]:
    """Return the force of a step by y before it and by (y, ẏ/ω) after it.

    Without what the tractions remember; shapes (steps, rank, rank) and
    (steps, rank, 2 rank). The springs that the mean holds are taken off.
    """
    along, rank = sliders.along, sliders.along.shape[1]
    half = 0.5 * changes.elastic
    drag = changes.viscous / lengths[:, None, None]
    ahead = 0.5 * along.T @ slid.slides.motion[1:]
    ahead[:, :, :rank] += half + drag
    return half - drag, ahead


def _loose(carried: Array, sliders: Sliders, slid: SlidOrbit) -> Array:
    """Return the map with sliders that never slip as springs."""
    size, rank = len(carried), sliders.along.shape[1]
    first, stuck = size - sliders.count, slid.slides.stuck
    made = np.eye(size)
    made[first:][stuck, :rank] = (sliders.stiffness[:, None] * sliders.along)[stuck]
    kept = np.append(np.ones(first, dtype=bool), ~stuck)
    found: Array = (carried @ made[:, kept])[kept]
    return found
