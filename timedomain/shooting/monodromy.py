"""What a period of the march does to a small motion, without memory (theory §7.3).

With φ the contact force, of tangents D at the new and at the old time, a step is

    s₁ = A s₀ + b (φ₀ + φ₁) + load ,    δφ = D W δs ,

and z = δs − b δφ turns its derivative into a matrix of rank r more than A:

    z₁ = (A + c E W) z₀ ,   c = A b + b ,   E = (1 − D W b)⁻¹ D .

Steps are taken together in blocks, each a constant power of A and a small matrix.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import solve_triangular

from microslip_mechanics.arrays import Array
from timedomain.shooting.period_map import BLOCK, PeriodMap


def monodromy_of(period_map: PeriodMap, tangents: Array) -> Array:
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
