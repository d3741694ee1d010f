"""A first point where a drive parts what is pressed together (theory §6.2).

A drive that grows leads to the corner at which stiff faces first part, and from there
through fold after fold. Soft ones part gently; as they stiffen under the whole drive
they keep to the motion that rattles, with the preload in the mean.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

import numpy as np
from numpy.typing import NDArray

from hbm.balance.relative import RelativeProblem
from hbm.continuation.arc import Metric
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.followed import followed
from hbm.curves.share_arc import along_an_arc
from hbm.curves.stiffened import depths, soft, stiffening, stops
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import AlongShare, Easier, arrived, driven
from hbm.paths.path import Path
from microslip_mechanics.arrays import Array, largest

PRESSED = 1e-6
"""depth over the motion without contacts, below which faces are not pressed together: a
body that nothing holds there goes away, and no drive parts it from them"""
SOFTEST = FourierBasis(7, 128)
"""resolution of the response with which it begins"""
ARCS = ((FourierBasis(31, 512), 1500), (FourierBasis(63, 1024), 3000))
"""resolutions of arcs along which stops stiffen, and evaluations after which each is
given up; those that arrive take some 500 and 1000"""


def parted(
    path: Path,
    parameter: float,
    control: StepControl,
    effort: Effort,
    metric: Metric,
    *,
    arcs: int,
) -> Iterator[Array]:
    """Yield coefficients of responses at a parameter, (2H + 1, rank) each.

    There are as many as the first ``arcs`` lead to; none where all stops may begin soft
    under any drive, where there are none, or where nothing presses them.
    """
    problem, frequency = path.at(parameter)
    stiffer = stiffening(problem, frequency, stops(problem))
    if stiffer is None or not _pressed(problem, frequency).any():
        return
    seen = control, effort, metric
    begun = partial(followed, path, parameter, _softest(stiffer), SOFTEST, *seen)
    for known in arrived([begun]):
        shares = AlongShare(path, parameter, stiffer, 0.0, known=known)
        yield from arrived(
            partial(along_an_arc, shares, 0.0, fourier, patience, *seen)
            for fourier, patience in ARCS[:arcs]
        )


def _pressed(problem: RelativeProblem, frequency: float) -> NDArray[np.bool_]:
    """Return which stops are pressed at rest and may not begin soft, (points,)."""
    least = PRESSED * largest(problem.apart(frequency))
    found: NDArray[np.bool_] = stops(problem) & ~soft(problem)
    return found & (depths(problem) > least)


def _softest(stiffer: Easier) -> Easier:
    """Return what makes stops as soft as can be, at rest, and then lets a drive grow.

    It begins with the static equilibrium of the problem itself.
    """

    def softer(problem: RelativeProblem, share: float) -> RelativeProblem:
        if share <= 0.5:
            return driven(stiffer(problem, 1.0 - 2.0 * share), 0.0)
        return driven(stiffer(problem, 0.0), 2.0 * share - 1.0)

    return softer
