"""A coarse response of a problem to which easier ones lead, step by step (§6.2)."""

from __future__ import annotations

from hbm.balance.residual import HarmonicBalance
from hbm.continuation.arc import Metric
from hbm.continuation.corrected import correct_at
from hbm.continuation.effort import Effort
from hbm.continuation.step_control import StepControl
from hbm.errors import ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.paths.along_share import Easier
from hbm.paths.path import Path
from microslip_mechanics.arrays import Array

SMALLEST_STEP = 1e-3


def followed(
    path: Path,
    parameter: float,
    easier: Easier,
    fourier: FourierBasis,
    control: StepControl,
    effort: Effort,
    metric: Metric,
) -> Array:
    """Return the coefficients at the end of a homotopy, shape (2H + 1, rank).

    Raises
    ------
    ContinuationError
        If it does not arrive.
    """
    problem, frequency = path.at(parameter)
    mask = path.mask(fourier.harmonics)
    place, step = 0.0, 0.25
    point = HarmonicBalance(problem, fourier, mask).point(
        problem.rest[None, :], frequency
    )
    while place < 1.0:
        target = min(1.0, place + step)
        balance = HarmonicBalance(easier(problem, target), fourier, mask)
        try:
            counted = effort.counted(balance, fourier.harmonics)
            found = correct_at(counted, point, control, metric=metric).point
        except ContinuationError:
            step *= 0.5
            if step < SMALLEST_STEP:
                raise
            continue
        point, place, step = found, target, 1.5 * step
    return point[:-1].reshape(fourier.coefficients, problem.rank)
