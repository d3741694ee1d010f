"""A first point by stops that stiffen from nothing (theory §6.2).

A motion under the whole drive that lifts off soft stops does so for most of a period:
as they stiffen it passes none of the corners at which a growing drive first lifts off
or strikes, and beyond which stiff stops send it through fold after fold.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hbm.balance.relative import RelativeProblem
from hbm.paths.along_share import Easier
from microslip_mechanics.arrays import Array, largest
from microslip_mechanics.contact.points import FRICTIONLESS, ONE_SIDED

SOFT = 0.1
"""stiffness with which all stops begin together, over what resists there without them:
it hardly changes the motion, however stiff stops and structure are"""
LEAST = 1e-12
"""share of its own stiffness with which a stop begins at the least"""


def stiffening(
    problem: RelativeProblem, frequency: float, may: NDArray[np.bool_]
) -> Easier | None:
    """Return what makes stops softer; None if there is none that ``may`` begin soft.

    A stop keeps its damping ratio, so that an impact leaves as much of its speed.
    """
    if not may.any():
        return None
    shares = np.where(may, _shares(problem, frequency) / may.sum(), 1.0)
    least = np.clip(shares, LEAST, 1.0)

    def stiffer(problem: RelativeProblem, share: float) -> RelativeProblem:
        """Return the problem with softer stops."""
        points, part = problem.points, least ** (1.0 - share)
        stiffness, damping = points.stiffness * part, points.damping * np.sqrt(part)
        softer = points._replace(stiffness=stiffness, damping=damping)
        return replace(problem, points=softer)

    return stiffer


def _shares(problem: RelativeProblem, frequency: float) -> Array:
    """Return the stiffness with which each stop alone may begin, over its own.

    It hardly changes how its point moves without contacts. One that stays still there
    may be struck as deep as any other moves.
    """
    points, normals = problem.points, problem.basis[::3]
    stiffness = problem.condensed.dynamic_stiffness(np.array([1j * frequency]))[0]
    yielding = np.linalg.lstsq(stiffness, normals.T.astype(complex), rcond=None)[0]
    compliance = np.abs(np.einsum("pr,rp->p", normals, yielding))
    depth = largest(np.abs(problem.apart(frequency)[::3]))
    own = points.stiffness * depth ** (points.exponent - 1.0) * compliance
    shares: Array = np.divide(SOFT, own, out=np.ones_like(own), where=own > 0.0)
    return shares


def stops(problem: RelativeProblem) -> NDArray[np.bool_]:
    """Return which points are stops, shape (points,)."""
    points = problem.points
    found: NDArray[np.bool_] = (points.normal == ONE_SIDED) & (points.stiffness > 0.0)
    return found


def soft(problem: RelativeProblem) -> NDArray[np.bool_]:
    """Return which stops may begin soft beside any drive, shape (points,).

    Those on which nothing rubs, or that are open at rest: others press together what
    friction is to hold.
    """
    smooth = problem.points.friction == FRICTIONLESS
    found: NDArray[np.bool_] = stops(problem) & ((depths(problem) < 0.0) | smooth)
    return found


def depths(problem: RelativeProblem) -> Array:
    """Return how deep faces are pressed together at rest [m], shape (points,)."""
    place = problem.basis @ problem.rest + problem.offset
    depth: Array = place[::3] - problem.points.gap
    return depth
