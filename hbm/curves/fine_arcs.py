"""Arcs to a whole problem that are as finely resolved as it asks for (theory §6.2).

What a sudden force excites, and a coarse resolution does not have, is why nothing leads
from coarse responses to finer ones.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from hbm.continuation.arc import Metric
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.curves.grown import Resolved, grown
from hbm.curves.share_arc import along_an_arc
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import AlongShare, arrived
from microslip_mechanics.arrays import Array

ARC, FINEST = FourierBasis(63, 1024), FourierBasis(255, 4096)
"""fixed resolutions"""
PATIENCE = 3000
"""evaluations after which the first arc is given up; of those that arrive few take more
than 1500"""
FINE = 400
"""the same of the finest arc"""
UNKNOWNS = 4000
"""of fixed harmonics, at the most: factors of more take too long"""


def fine_arcs(
    shares: AlongShare,
    resolved: Resolved,
    control: StepControl,
    effort: Effort,
    metric: Metric,
    *,
    patience: float,
    finest: bool,
) -> Iterator[Array]:
    """Yield coefficients of responses of the whole problem, (2H + 1, rank) each.

    They have fixed harmonics, then those that each share asks for, which are given up
    after ``patience`` evaluations of 31 harmonics, then, if ``finest``, the most.
    """

    def arc(fourier: FourierBasis, patience: float) -> Array:
        return along_an_arc(shares, 0.0, fourier, patience, control, effort, metric)

    if finest or ARC.coefficients * shares.rank <= UNKNOWNS:
        yield from arrived([partial(arc, ARC, PATIENCE)])
    yield from arrived(
        [partial(grown, shares, 0.0, resolved, patience, control, effort)]
    )
    if finest and FINEST.coefficients * shares.rank <= UNKNOWNS:
        yield from arrived([partial(arc, FINEST, FINE)])
