"""Mean motions that nothing but friction holds, pinned (theory §6.1)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hbm.balance.relative import RelativeProblem
from hbm.forces.fourier import FourierBasis
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import FRICTIONLESS, RIGID, ContactPoints

LOOSE, GAUGE = 1e-11, 1e-6
"""of the largest stiffness: up to which nothing holds a mean motion, and by which that
is pinned then"""
SLIGHT = 1e-9
"""of the stiffness of sliders that stick, by which what they hold is pinned besides"""


def pinned(problem: RelativeProblem) -> RelativeProblem:
    """Return the problem with mean motions that nothing but friction holds pinned.

    Without a rope, say, the mean position of the friction element is arbitrary;
    pinning it changes no force as long as no mean force acts along it. What sticks
    holds it besides, where friction remembers.
    """
    rank = problem.rank
    if rank == 0:
        return problem
    contact = replace(problem, points=_sliding(problem.points)).contact(
        FourierBasis(1, 8)
    )
    contact(np.vstack([problem.rest, np.zeros((2, rank))]), 1.0)
    held = problem.condensed.stiffness + contact.tangents.means()[0]
    sizes, directions = np.linalg.eigh((held + held.T) / 2.0)
    largest = max(float(sizes[-1]), np.finfo(float).tiny)
    loose = directions[:, np.abs(sizes) <= LOOSE * largest]
    if sizes[-1] <= 0.0:
        largest = float(np.abs(np.diag(problem.condensed.mass)).max())
    sticking, loose = _sticking(problem, loose)
    pins = np.where(sticking > LOOSE * largest, SLIGHT * sticking, GAUGE * largest)
    return replace(problem, loose=loose, gauge=(loose * pins) @ loose.T)


def _sticking(problem: RelativeProblem, loose: Array) -> tuple[Array, Array]:
    """Return the stiffness that sticking sliders have along motions, and these.

    They are turned until it is diagonal.
    """
    points = problem.points
    stiffness = np.where(remembers(points), points.tangential, 0.0)
    springs = np.outer(stiffness, [0.0, 1.0, 1.0]).ravel()
    seen = problem.basis @ loose
    sizes, turn = np.linalg.eigh(seen.T @ (springs[:, None] * seen))
    return sizes, loose @ turn


def _sliding(points: ContactPoints) -> ContactPoints:
    """Return the points with rigid ones free to slide: they hold no mean position."""
    rigid = points.friction == RIGID
    return points._replace(friction=np.where(rigid, FRICTIONLESS, points.friction))
