"""Newton's change of all states of a period at once (theory §7.3).

It obeys z₁ = (A + c E W) z₀ − r and δs = z + b E W z, with what each step leaves, r.
Blocks of steps are maps of the z with which they begin; the chain of blocks is solved
without being followed.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from timedomain.shooting.cyclic_system import cyclic_solution
from timedomain.shooting.period_map import BLOCK


class Pushed(NamedTuple):
    """The forces E W z of a block, from the z with which it begins and from r."""

    by_begin: Array
    """shape (blocks, BLOCK rank, size)"""
    rest: Array
    """shape (blocks, BLOCK rank)"""


def whole_change(
    free: Array, push: Array, seen: Array, tangents: Array, left: Array
) -> Array:
    """Return δs at all times.

    Parameters
    ----------
    free, push, seen
        A, b and W; shapes (size, size), (size, rank), (2 rank, size).
    tangents
        D at the begin of each step, shape (steps, rank, 2 rank).
    left
        r of each step, shape (steps, size).

    Returns
    -------
    Shape (steps, size).

    Raises
    ------
    LinAlgError
        If the equations have no solution, or none in finite numbers.
    """
    size, rank = push.shape
    answers = np.linalg.solve(np.eye(rank) - tangents @ (seen @ push), tangents)
    blocks = answers.reshape(len(answers) // BLOCK, BLOCK, rank, 2 * rank)
    rests = left.reshape(-1, BLOCK, size)
    kick = free @ push + push
    powers = [np.eye(size)]
    for _ in range(BLOCK):
        powers.append(free @ powers[-1])
    drift = [np.zeros((len(blocks), size))]
    for place in range(BLOCK):
        drift.append(drift[-1] @ free.T - rests[:, place])
    pushed = _pushed(blocks, seen, kick, powers, np.stack(drift[:BLOCK], axis=1))
    kicked = np.hstack([power @ kick for power in powers[BLOCK - 1 :: -1]])
    maps = powers[BLOCK] + kicked @ pushed.by_begin
    begins = cyclic_solution(maps, drift[BLOCK] + pushed.rest @ kicked.T)
    forces = np.einsum("bwi,bi->bw", pushed.by_begin, begins) + pushed.rest
    return _within(
        free, push, kick, begins, forces.reshape(len(blocks), BLOCK, rank), rests
    )


def _pushed(
    blocks: Array, seen: Array, kick: Array, powers: Sequence[Array], drift: Array
) -> Pushed:
    """Return the forces in all blocks.

    ``drift``, shape (blocks, BLOCK, size), is z without forces from z = 0.
    """
    count, _, rank, double = blocks.shape
    coupled = np.zeros((BLOCK, double, BLOCK, rank))
    for late in range(BLOCK):
        for early in range(late):
            coupled[late, :, early] = seen @ powers[late - 1 - early] @ kick
    width = BLOCK * rank
    lag = (blocks @ coupled.reshape(BLOCK, double, width)).reshape(count, width, width)
    watched = np.stack([seen @ power for power in powers[:BLOCK]])
    by_begin = (blocks @ watched).reshape(count, width, drift.shape[2])
    rest = (blocks @ (drift @ seen.T)[..., None]).reshape(count, width, 1)
    found = np.linalg.solve(np.eye(width) - lag, np.dstack([by_begin, rest]))
    return Pushed(found[:, :, :-1], found[:, :, -1])


def _within(
    free: Array, push: Array, kick: Array, begins: Array, forces: Array, rests: Array
) -> Array:
    """Return δs at all times from the forces, which no longer depend on it."""
    change, moved = np.empty_like(rests), begins
    for place in range(BLOCK):
        change[:, place] = moved + forces[:, place] @ push.T
        moved = moved @ free.T + forces[:, place] @ kick.T - rests[:, place]
    return change.reshape(-1, rests.shape[2])
