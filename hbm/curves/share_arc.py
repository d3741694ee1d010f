"""An arc from an easier problem to a whole one, through its folds (theory §6.2)."""

from __future__ import annotations

import numpy as np

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import Metric
from hbm.continuation.continuation import trace
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import UNIT, AlongShare, whole
from microslip_mechanics.arrays import Array


def along_an_arc(
    shares: AlongShare,
    first: float,
    fourier: FourierBasis,
    patience: float,
    control: StepControl,
    effort: Effort,
    metric: Metric,
) -> Array:
    """Return the coefficients of a response of the whole problem, (2H + 1, rank).

    The share changes from ``first`` on, at one resolution. After ``patience``
    evaluations it is given up; ``effort`` counts them, ``metric`` measures the motion.

    Raises
    ------
    ContinuationError
        If it does not arrive.
    """

    def scale(point: Array) -> Array:
        return np.append(metric(point)[:-1], UNIT)

    balance, (easy, _) = shares.balance(fourier), shares.at(first)
    mask = shares.mask(fourier.harmonics)
    start = HarmonicBalance(easy, fourier, mask).point(shares.begins(first), first)
    counted = effort.counted(balance, fourier.harmonics)
    system = Effort(patience).counted(counted, 1)
    corrections = trace(
        system, start, 1.0, metric=scale, control=control, begin=shares.least
    )
    point = whole(corrections, shares.place)
    return point[:-1].reshape(fourier.coefficients, shares.rank)
