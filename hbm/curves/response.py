"""The periodic response at a corrected point."""

from __future__ import annotations

import math

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.correction import Correction
from hbm.errors import ContinuationError
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse

DRIFT = 1e-6
"""mean force on a free body over the force scale, from which it drifts"""


def response(
    problem: Problem, balance: HarmonicBalance, correction: Correction
) -> PeriodicResponse:
    """Return the periodic response at a corrected point.

    Raises
    ------
    ContinuationError
        If a body that nothing holds drifts.
    """
    point = correction.point
    drift, frequency = balance.drift_force(point), float(point[-1])
    if drift > DRIFT * problem.force_scale:
        raise ContinuationError(
            f"a body drifts at {frequency / math.tau:.6g} Hz: friction has a mean of "
            f"{drift:.2g} N and nothing holds the body; hold it by a spring"
        )
    cycle = balance.cycle(point)
    return PeriodicResponse(
        frequency,
        balance.motion(point),
        cycle.normal_smallest,
        cycle.normal_largest,
        cycle.friction,
        cycle.normal_damping,
        correction.residuals[-1],
        correction.outcome.name.lower(),
        correction.iterations,
        balance.fourier.harmonics,
        balance.fourier.samples,
    )
