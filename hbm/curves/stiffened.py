"""A first point by stops that stiffen from nothing (theory §6.2).

A motion under the whole drive that lifts off soft stops does so for most of a period:
as they stiffen it passes none of the corners at which a growing drive first lifts off
or strikes, and beyond which stiff stops send it through fold after fold.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from hbm.balance.relative import RelativeProblem
from hbm.continuation.arc import Metric
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.grown import Resolved, grown
from hbm.curves.share_arc import along_an_arc
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import AlongShare, Easier, arrived
from hbm.paths.path import Path
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import FRICTIONLESS, ONE_SIDED

SOFT = 0.1
"""stiffness with which all stops begin together, over what resists there without them:
it hardly changes the motion, however stiff stops and structure are"""
LEAST = 1e-12
"""share of its own stiffness with which a stop begins at the least"""
ARC, FINEST = FourierBasis(63, 1024), FourierBasis(255, 4096)
"""resolutions of arcs: what stiff stops excite, and a coarse one does not have, is why
nothing leads from coarse responses to finer ones"""
PATIENCE = 1500
"""evaluations after which the first arc is given up; few of those that arrive take more
than 1000"""
RESOLVED, FINE = 15000, 600
"""the same where each stiffness is as finely resolved as it asks for, of 31 harmonics,
and of the finest arc"""
UNKNOWNS = 4000
"""of an arc, at the most: factors of more take too long"""


def stiffened(
    path: Path,
    parameter: float,
    resolved: Resolved,
    control: StepControl,
    effort: Effort,
    metric: Metric,
) -> Iterator[Array]:
    """Yield coefficients of responses, (2H + 1, rank) each, ever finer ones.

    They have fixed harmonics, then those that each stiffness asks for, then the most.
    None if there are no stops that may begin soft.
    """
    stiffer = stiffening(*path.at(parameter))
    if stiffer is None:
        return
    shares = AlongShare(path, parameter, stiffer, 0.0)

    def arc(fourier: FourierBasis, patience: float) -> Array:
        return along_an_arc(shares, 0.0, fourier, patience, control, effort, metric)

    yield from arrived(
        [
            partial(arc, ARC, PATIENCE),
            partial(grown, shares, 0.0, resolved, RESOLVED, control, effort),
        ]
    )
    if FINEST.coefficients * path.rank <= UNKNOWNS:
        yield from arrived([partial(arc, FINEST, FINE)])


def stiffening(problem: RelativeProblem, frequency: float) -> Easier | None:
    """Return what makes stops softer; None if there is none that may begin soft."""
    may = soft(problem)
    if not may.any():
        return None
    shares = np.where(may, _shares(problem, frequency) / may.sum(), 1.0)
    least = np.clip(shares, LEAST, 1.0)

    def stiffer(problem: RelativeProblem, share: float) -> RelativeProblem:
        """Return the problem with softer stops."""
        stiffness = problem.points.stiffness * least ** (1.0 - share)
        return replace(problem, points=problem.points._replace(stiffness=stiffness))

    return stiffer


def _shares(problem: RelativeProblem, frequency: float) -> Array:
    """Return the stiffness with which each stop alone may begin, over its own.

    It hardly changes how its point moves without contacts.
    """
    points, normals = problem.points, problem.basis[::3]
    stiffness = problem.condensed.dynamic_stiffness(np.array([1j * frequency]))[0]
    yielding = np.linalg.lstsq(stiffness, normals.T.astype(complex), rcond=None)[0]
    compliance = np.abs(np.einsum("pr,rp->p", normals, yielding))
    depth = np.abs(problem.apart(frequency)[::3])
    own = points.stiffness * depth ** (points.exponent - 1.0) * compliance
    shares: Array = np.divide(SOFT, own, out=np.ones_like(own), where=own > 0.0)
    return shares


def soft(problem: RelativeProblem) -> NDArray[np.bool_]:
    """Return which stops may begin soft, shape (points,).

    Those on which nothing rubs, or that are open at rest: others press together what
    friction is to hold.
    """
    points = problem.points
    opens = (points.normal == ONE_SIDED) & (points.stiffness > 0.0)
    depth = (problem.basis @ problem.rest + problem.offset)[::3] - points.gap
    found: NDArray[np.bool_] = opens & (
        (depth < 0.0) | (points.friction == FRICTIONLESS)
    )
    return found
