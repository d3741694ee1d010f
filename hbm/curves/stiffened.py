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
from hbm.continuation.arc import Metric
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.share_arc import along_an_arc
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import AlongShare
from hbm.paths.path import Path
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import FRICTIONLESS, ONE_SIDED

SOFT = 1e-6
"""stiffness with which stops begin, over what they have"""
FOURIER = FourierBasis(63, 1024)
"""resolution of the arc: what stiff stops excite, and a coarse one does not have, is
why nothing leads from coarse responses to finer ones"""
PATIENCE = 3000
"""evaluations after which it is given up; of those that arrive few take more than
1500"""


def stiffened(
    path: Path, parameter: float, control: StepControl, effort: Effort, metric: Metric
) -> Array | None:
    """Return the coefficients of a response, (2H + 1, rank); None if none is found."""
    problem, _ = path.at(parameter)
    if not soft(problem).any():
        return None
    shares = AlongShare(path, parameter, stiffer, 0.0)
    try:
        return along_an_arc(shares, 0.0, FOURIER, PATIENCE, control, effort, metric)
    except ContinuationError:
        return None


def stiffer(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem with softer stops."""
    factor = np.where(soft(problem), SOFT ** (1.0 - share), 1.0)
    points = problem.points._replace(stiffness=problem.points.stiffness * factor)
    return replace(problem, points=points)


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
