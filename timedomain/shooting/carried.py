"""What a period of the march does to a small change, with memory (theory §7.3)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.sliders import Sliders
from microslip_mechanics.contact.slides import Slides


def carried(
    free: Array,
    push: Array,
    seen: Array,
    tangents: Array,
    sliders: Sliders,
    slides: Slides,
) -> tuple[Array, Array]:
    """Return what a period does to a small change of the state (s, T).

    Parameters
    ----------
    free, push
        A and b of a step (:mod:`timedomain.shooting.period_map`).
    seen
        W, (y, ẏ/ω) from s.
    tangents
        D of the other laws at each time, shape (times, rank, 2 rank).
    sliders, slides
        What remembers, and what it did.

    Returns
    -------
    Derivatives of the state after the period, shape ``(states, states)``, and of what
    can be taken off the tractions, shape ``(sliders, states)``: that of their mean
    beside those of what floats, or, of what then comes to its limit, of its excess.
    """
    size, rank = push.shape
    pull, bending = sliders.along.T, sliders.bending
    whole = np.eye(size + sliders.count)
    moved, held = whole[:size], whole[size:]
    force = tangents[0] @ (seen @ moved) + pull @ held
    moved = moved - push @ force
    slid = seen @ whole[:size]
    answers = tangents + pull @ slides.motion
    solvers = np.linalg.inv(np.eye(rank) - answers @ (seen @ push))
    kick, total = free @ push + push, np.zeros_like(held)
    brink, excess = slides.brink, np.zeros_like(held)
    for place in range(1, len(tangents)):
        moved = free @ moved + kick @ force
        watched = seen @ moved
        memory = slides.traction_past[place] @ held - slides.past[place] @ slid
        force = solvers[place] @ (answers[place] @ watched + pull @ memory)
        watched += (seen @ push) @ force
        held = slides.motion[place] @ watched + memory
        slid, total = watched, total + held - bending @ watched[: push.shape[1]]
        ends = np.flatnonzero(brink.place == place)
        excess[ends] = brink.pull[ends] @ held + brink.push[ends] @ watched
    mean = total / (len(tangents) - 1)
    shed = np.where((brink.place > 0)[:, None], excess, mean)
    return np.vstack([moved + push @ force, held]), shed
