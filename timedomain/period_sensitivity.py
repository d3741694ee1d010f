"""The exact derivative of what a period of the reference march does to a state.

With φ the contact force, of tangents D at the new and at the old time, a step is

    s₁ = A s₀ + b (φ₀ + φ₁) + load ,    δφ = D W δs ,

and z = δs − b δφ turns its derivative into a matrix of rank r more than A:

    z₁ = (A + c E W) z₀ ,   c = A b + b ,   E = (1 − D W b)⁻¹ D .

Steps are taken together in blocks, each a constant power of A and a small matrix. With
friction that remembers the tractions are part of the state, and steps are taken one by
one (:mod:`timedomain.carried`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ONE_SIDED, RIGID
from timedomain.carried import carried
from timedomain.period_map import BLOCK, Period, PeriodMap
from timedomain.start import Start

PARTS = 32
"""of a step, in which tangents are looked at"""
NUDGE = 1e-6
"""of the vibration, for derivatives by differences"""


class Sensitivity(NamedTuple):
    """Derivatives by the state before a period."""

    monodromy: Array
    """of the state after it, shape (states, states)"""
    mean: Array
    """of the mean tractions over it, in units of states, shape (sliders, states)"""


def sensitivity_of(period_map: PeriodMap, period: Period) -> Sensitivity:
    """Return the exact derivatives of what a march does by the state before it."""
    if period_map.sliders.count == 0:
        whole = _without_memory(period_map, period)
        return Sensitivity(whole, np.zeros((0, len(whole))))
    return _with_memory(period_map, period)


def small_motions(period_map: PeriodMap, period: Period) -> Array | None:
    """Return what becomes of a small motion in a period, (states, states).

    The march's own derivative knows the time that a stop is touched to whole steps
    only. Here the tangents of steps in which a point touches or parts are means over
    them, along a motion that is linear from sample to sample. None where no point
    does, or contacts remember or are rigid.
    """
    rigid = (period_map.problem.interface.points.friction == RIGID).any()
    if rigid or period_map.sliders.count:
        return None
    passed = _touching(period_map, period)
    if not passed.size:
        return None
    return _carried(period_map, _mean_tangents(period_map, period, passed))


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


def _with_memory(period_map: PeriodMap, period: Period) -> Sensitivity:
    """Return the derivatives of a period with what contacts remember."""
    free, push = period_map.step(-period_map.structure.selection.T)
    units = np.append(np.ones(len(free)), period_map.unit)
    tangents = period_map.tangents(
        *period_map.points(period.displacement, period.velocity)
    )
    monodromy, mean = carried(
        free, push, period_map.seen, tangents, period_map.sliders, period.slides
    )
    monodromy = monodromy * units / units[:, None]
    return Sensitivity(monodromy, mean * units / period_map.unit[:, None])


def _without_memory(period_map: PeriodMap, period: Period) -> Array:
    """Return the derivative of the state after a period without memory.

    With rigid friction, which has no tangents, it is that of differences.
    """
    if (period_map.problem.interface.points.friction == RIGID).any():
        return _differences(period_map, period)
    tangents = period_map.tangents(
        *period_map.points(period.displacement, period.velocity)
    )
    return _carried(period_map, tangents)


def _carried(period_map: PeriodMap, tangents: Array) -> Array:
    """Return the derivative over a period from the tangents at the samples."""
    free, push = period_map.step(-period_map.structure.selection.T)
    seen = period_map.seen
    answers = np.linalg.solve(
        np.eye(push.shape[1]) - tangents @ (seen @ push), tangents
    )
    product = _product(free, push, seen, answers[:-1])
    whole: Array = np.eye(len(free))
    before = whole - push @ tangents[0] @ seen
    made: Array = (whole + push @ answers[-1] @ seen) @ product @ before
    return made


def _touching(period_map: PeriodMap, period: Period) -> NDArray[np.int64]:
    """Return the steps in which a point touches or lifts off."""
    points = period_map.problem.interface.points
    moved, _ = period_map.points(period.displacement, period.velocity)
    closed = moved[:, :, 0] > points.gap
    passes = (closed[1:] != closed[:-1]) & (points.normal == ONE_SIDED)
    return np.flatnonzero(passes.any(axis=1))


def _mean_tangents(
    period_map: PeriodMap, period: Period, passed: NDArray[np.int64]
) -> Array:
    """Return the tangents at the samples, shared by the half steps around each.

    Each half of the steps ``passed`` has the mean over itself instead.
    """
    motion = period.displacement, period.velocity
    own = period_map.tangents(*period_map.points(*(each[:-1] for each in motion)))
    halves = own / 2.0, np.roll(own, -1, axis=0) / 2.0
    shares = np.split((np.arange(PARTS) + 0.5) / PARTS, 2)
    for half, parts in zip(halves, shares, strict=True):
        along = parts[:, None, None]
        between = [
            ((1.0 - along) * each[passed] + along * each[passed + 1]).reshape(
                -1, each.shape[1]
            )
            for each in motion
        ]
        found = period_map.tangents(*period_map.points(*between))
        half[passed] = found.reshape(parts.size, passed.size, *own.shape[1:]).sum(0)
        half[passed] /= PARTS
    mean = halves[0] + np.roll(halves[1], 1, axis=0)
    return np.concatenate([mean, mean[:1]])


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


def _product(free: Array, push: Array, seen: Array, answers: Array) -> Array:
    """Return the product of A + c E W over all steps, later ones on the left.

    ``answers`` holds E of each step, shape ``(steps, rank, 2 rank)``.
    """
    size, rank = push.shape
    count = len(answers) // BLOCK
    blocks = answers.reshape(count, BLOCK, rank, 2 * rank)
    powers = [np.eye(size)]
    for _ in range(BLOCK):
        powers.append(free @ powers[-1])
    kick = free @ push + push
    watched = np.stack([seen @ power for power in powers[:BLOCK]])
    kicked = np.hstack([power @ kick for power in powers[BLOCK - 1 :: -1]])
    coupled = np.zeros((BLOCK, 2 * rank, BLOCK, rank))
    for late in range(BLOCK):
        for early in range(late):
            coupled[late, :, early] = watched[late - 1 - early] @ kick
    width = BLOCK * rank
    lag = blocks @ coupled.reshape(BLOCK, 2 * rank, width)
    drive = (blocks @ watched).reshape(count, width, size)
    carried = powers[0]
    for delay, driven in zip(lag.reshape(count, width, width), drive, strict=True):
        forces = solve_triangular(
            -delay, driven, lower=True, unit_diagonal=True, check_finite=False
        )
        carried = (powers[BLOCK] + kicked @ forces) @ carried
    return carried
