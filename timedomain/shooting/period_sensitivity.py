"""The exact derivative of what a period of the reference march does to a state.

With friction that remembers the tractions are part of the state, and steps are taken
one by one (:mod:`timedomain.shooting.carried`); without, a small matrix each
(:mod:`timedomain.shooting.monodromy`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import RIGID
from timedomain.record.start import Start
from timedomain.shooting.carried import carried
from timedomain.shooting.monodromy import monodromy_of
from timedomain.shooting.period_map import Period, PeriodMap

NUDGE = 1e-6
"""of the vibration, for derivatives by differences"""


class Sensitivity(NamedTuple):
    """Derivatives by the state before a period."""

    monodromy: Array
    """of the state after it, shape (states, states)"""
    shed: Array
    """of what can be taken off the tractions, in units of states, (sliders, states)"""


def sensitivity_of(period_map: PeriodMap, period: Period) -> Sensitivity:
    """Return the exact derivatives of what a march does by the state before it."""
    if period_map.sliders.count == 0:
        whole = _without_memory(period_map, period)
        return Sensitivity(whole, np.zeros((0, len(whole))))
    tangents = period_map.tangents(
        period_map.points(period.displacement, period.velocity), period_map.length
    )
    return carried_state(period_map, period, tangents)


def loose_monodromy(
    period_map: PeriodMap, monodromy: Array, stuck: NDArray[np.bool_]
) -> Array:
    """Return the derivative of what is left if some sliders are springs.

    A slider that never slips keeps T − k_t w: that is a multiplier of exactly one,
    which says nothing but that its position is free.
    """
    sliders, size = period_map.sliders, len(monodromy)
    first = size - sliders.count
    made = np.eye(size)
    seen = sliders.along @ period_map.structure.selection
    springs = (sliders.stiffness / period_map.unit)[:, None] * seen
    made[first:][stuck, : first // 2] = springs[stuck]
    kept = np.append(np.ones(first, dtype=bool), ~stuck)
    found: Array = (monodromy @ made[:, kept])[kept]
    return found


def carried_state(
    period_map: PeriodMap, period: Period, tangents: Array
) -> Sensitivity:
    """Return the derivatives of a period with what contacts remember.

    ``tangents`` are those at the samples, shape (steps + 1, rank, 2 rank).
    """
    free, push = period_map.step(-period_map.structure.selection.T)
    units = np.append(np.ones(len(free)), period_map.unit)
    monodromy, shed = carried(
        free, push, period_map.seen, tangents, period_map.sliders, period.slides
    )
    monodromy = monodromy * units / units[:, None]
    return Sensitivity(monodromy, shed * units / period_map.unit[:, None])


def _without_memory(period_map: PeriodMap, period: Period) -> Array:
    """Return the derivative of the state after a period without memory.

    With rigid friction, which has no tangents, it is that of differences.
    """
    if (period_map.problem.interface.points.friction == RIGID).any():
        return _differences(period_map, period)
    tangents = period_map.tangents(
        period_map.points(period.displacement, period.velocity), period_map.length
    )
    return monodromy_of(period_map, tangents)


def _differences(period_map: PeriodMap, period: Period) -> Array:
    """Return the derivative by marches from states nearby."""
    motions = np.hstack([period.displacement, period.velocity / period_map.frequency])
    to_modes = np.kron(np.eye(2), period_map.structure.inverse)
    nudge = NUDGE * float(np.linalg.norm(np.ptp(motions @ to_modes.T, axis=0)))
    start = period_map.state(Start(period.displacement[0], period.velocity[0]))
    ends = []
    for push in np.vstack([np.zeros(start.size), nudge * np.eye(start.size)]):
        near = period_map.march(start + push)
        ends.append(period_map.state(Start(near.displacement[-1], near.velocity[-1])))
    derivative: Array = (np.array(ends[1:]) - ends[0]).T / nudge
    return derivative
