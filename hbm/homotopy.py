"""A first point where Newton's iteration resists: easier problems lead to it (§6)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from hbm.active import extended
from hbm.continuation import ContinuationError, StepControl, correct_at
from hbm.fourier import FourierBasis
from hbm.relative import RelativeProblem
from hbm.residual import HarmonicBalance
from microslip_mechanics.arrays import Array

SMALLEST_STEP = 1e-3
FOURIERS = (FourierBasis(3, 128), FourierBasis(7, 128), FourierBasis(15, 256))
"""coarse resolutions that are tried in turn"""
SMOOTH = 1e4
"""times the threshold velocity with which a homotopy begins"""


def approached(
    problem: RelativeProblem,
    active: NDArray[np.bool_],
    frequency: float,
    control: StepControl,
) -> Iterator[tuple[str, Array]]:
    """Yield coefficients of the response at a frequency, and how they were found.

    The drive grows from nothing, or the threshold velocity of friction falls from a
    large value, or friction grows from nothing. What does not arrive is left out.
    """
    for fourier in FOURIERS:
        for name, easier in HOMOTOPIES.items():
            try:
                yield (
                    name,
                    _followed(problem, easier, fourier, active, frequency, control),
                )
            except ContinuationError:
                continue


def _followed(
    problem: RelativeProblem,
    easier: Callable[[RelativeProblem, float], RelativeProblem],
    fourier: FourierBasis,
    active: NDArray[np.bool_],
    frequency: float,
    control: StepControl,
) -> Array:
    """Return the coefficients at the end of a homotopy, shape (2H + 1, rank).

    Raises
    ------
    ContinuationError
        If it does not arrive.
    """
    mask = extended(active, fourier.harmonics)
    place, step = 0.0, 0.25
    point = HarmonicBalance(problem, fourier, mask).point(
        problem.rest[None, :], frequency
    )
    while place < 1.0:
        target = min(1.0, place + step)
        balance = HarmonicBalance(easier(problem, target), fourier, mask)
        try:
            found = correct_at(balance, point, control).point
        except ContinuationError:
            step *= 0.5
            if step < SMALLEST_STEP:
                raise
            continue
        point, place, step = found, target, 1.5 * step
    return point[:-1].reshape(fourier.coefficients, problem.rank)


def _drive(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem under a share of the drive."""
    return replace(problem, force=problem.force * np.array([[1.0], [share]]))


def _threshold(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem with friction that is smoother near rest."""
    factor = SMOOTH ** (1.0 - share)
    points = problem.points._replace(threshold=problem.points.threshold * factor)
    return replace(problem, points=points)


def _friction(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem with a share of its friction."""
    points = problem.points._replace(
        dynamic=problem.points.dynamic * share, static=problem.points.static * share
    )
    return replace(problem, points=points)


HOMOTOPIES = {"drive": _drive, "threshold": _threshold, "friction": _friction}
