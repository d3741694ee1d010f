"""Touches so brief that what leaves turns on how it vibrates there (theory §6.4).

A mass m that strikes a stop k turns by √(k/m) times the time that it touches, about π;
its speed as it leaves, and what becomes of a small motion, go with that angle.
"""

from __future__ import annotations

import numpy as np

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.contact_path import ContactPath
from hbm.forces.sampled_orbit import SampledOrbit
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ONE_SIDED, ContactPoints
from microslip_mechanics.contact.tangents import contact_tangents

BRIEFLY = 25.0
"""angle by which a point turns while it touches [rad], up to which that is followed"""
PART = 0.02
"""angle of a step of second order [rad]"""
TURN = 2.0 * np.pi


def touched_times(
    contact: AlternatingFrequencyTime, path: ContactPath, *, half: bool
) -> Array:
    """Return for how long in a period each point touches that opens [s], (points,).

    Infinity for those that never do. ``path`` is the motion of the contact at an orbit,
    or ``half`` of it.
    """
    points = contact.points
    closed = path.displacement[::3, :-1] >= points.gap[:, None]
    times = path.length * np.count_nonzero(closed, axis=1)
    opens = (points.normal == ONE_SIDED) & ~closed.all(axis=1)
    if half:  # what its mirror image does in this half, it does in the other
        images = contact.symmetry.images
        times, opens = times + times[images], opens | opens[images]
    return np.where(opens, times, np.inf)


def vibration(
    points: ContactPoints,
    orbit: SampledOrbit,
    phase: Array,
    touched: Array,
    inertia: Array,
) -> Array:
    """Return how fast what touches briefly vibrates then [rad/s], shape (phases,).

    Zero where nothing does.

    Parameters
    ----------
    points, orbit
        The contacts, and how they move.
    phase
        When [rad].
    touched
        For how long each touches in a period [s], shape (points,).
    inertia
        What its normal stiffness moves [kg], shape (points,).
    """
    if np.isinf(touched).all():
        return np.zeros(phase.size)
    normals = np.kron(np.eye(inertia.size), np.eye(3, 1))
    elastic, _ = contact_tangents(points, normals, *orbit.at(phase))
    rates = np.sqrt(np.abs(np.diagonal(elastic, axis1=1, axis2=2)) / inertia)
    brief = np.isfinite(touched) & (
        rates * np.where(rates > 0.0, touched, 0.0) <= BRIEFLY
    )
    fastest: Array = np.where(brief, rates, 0.0).max(axis=1, initial=0.0)
    return fastest


def within_touches(
    points: ContactPoints,
    orbit: SampledOrbit,
    events: Array,
    touched: Array,
    inertia: Array,
) -> Array:
    """Return phases [rad] among events that resolve how points vibrate as they touch.

    ``events`` are those at which one touches or parts [rad]; the rest is what
    :func:`vibration` takes.
    """
    if events.size == 0:
        return events
    begins = np.unique(np.mod(events, TURN))
    lengths = np.diff(begins, append=begins[0] + TURN)
    middle = np.mod(begins + 0.5 * lengths, TURN)
    rates = vibration(points, orbit, middle, touched, inertia)
    counts = np.ceil(rates * lengths / orbit.frequency / PART).astype(int)
    found = [
        begin + length * np.arange(count) / count
        for begin, length, count in zip(
            begins, lengths, np.maximum(1, counts), strict=True
        )
    ]
    among: Array = np.mod(np.concatenate(found), TURN)
    return among
