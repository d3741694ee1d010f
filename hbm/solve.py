"""The public functions: from a problem to periodic responses along frequency."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hbm.active import ActiveUnknowns, moving
from hbm.continuation import (
    ContinuationError,
    Metric,
    StepControl,
    correct_at,
    trace,
)
from hbm.fourier import FourierBasis
from hbm.newton import Correction
from hbm.residual import HarmonicBalance
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState


@dataclass(frozen=True, slots=True)
class CurveOptions:
    """Range, resolution and accuracy of a frequency response curve."""

    start: float
    """first excitation frequency [rad/s]"""
    end: float
    """last excitation frequency [rad/s]"""
    harmonics: int = 8
    samples: int = 1024
    """per period"""
    tolerance: float = 1e-8
    """largest unbalanced force over the smaller of preload and drive"""
    largest_step: float = 0.25
    """relative change of the response, or share of a tenth of the range"""

    def __post_init__(self) -> None:
        """Check the range."""
        if self.start <= 0.0 or self.end <= 0.0 or self.start == self.end:
            raise ValueError(
                f"frequencies {self.start:g} and {self.end:g} rad/s: "
                "give two different positive ones"
            )


def frequency_response(
    problem: Problem, rest: StaticState, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses along the curve, one per continuation step.

    Parameters
    ----------
    problem
        What is solved.
    rest
        Its static equilibrium: the curve starts from it.
    options
        Range, harmonics, samples, tolerance.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    """
    fourier = FourierBasis(options.harmonics, options.samples)
    balance = HarmonicBalance(problem, rest, fourier)
    still = np.zeros((fourier.coefficients, problem.structure.dofs))
    still[0] = rest.displacement
    tolerance = options.tolerance * _force_scale(problem)
    control = StepControl(
        tolerance=tolerance,
        initial=min(0.02, options.largest_step),
        largest=options.largest_step,
    )
    first = correct_at(balance, balance.point(still, options.start), control)
    corrections = _restricted(balance, first.point, options, control)
    for correction in corrections:
        yield _response(balance, correction, problem)


def _restricted(
    balance: HarmonicBalance, start: Array, options: CurveOptions, control: StepControl
) -> Iterator[Correction]:
    """Yield points of the whole system, solved for in the active unknowns.

    Where an equation that is left out no longer holds, all unknowns take over.
    """
    active = ActiveUnknowns(balance, moving(balance, start))
    metric = _metric(balance.rank, abs(options.end - options.start) / 10.0)
    before, accepted = None, start
    for correction in trace(
        active, active.restricted(start), options.end, metric=metric, control=control
    ):
        if active.excluded > control.tolerance:
            break
        before, accepted = accepted, active.expanded(correction.point)
        yield replace(correction, point=accepted)
    else:
        return
    onwards = None if before is None else accepted - before
    whole = trace(
        balance,
        accepted,
        options.end,
        metric=metric,
        control=control,
        begin=options.start,
        direction=onwards,
    )
    next(whole)
    yield from whole


def periodic_response(
    problem: Problem,
    rest: StaticState,
    guess: PeriodicResponse,
    *,
    harmonics: int,
    samples: int,
    tolerance: float = 1e-8,
) -> PeriodicResponse:
    """Return the response at the frequency of ``guess`` with another resolution.

    Raises
    ------
    ContinuationError
        If the point does not converge.
    """
    balance = HarmonicBalance(problem, rest, FourierBasis(harmonics, samples))
    coefficients = np.zeros((2 * harmonics + 1, problem.structure.dofs))
    kept = min(len(coefficients), len(guess.coefficients))
    coefficients[:kept] = guess.coefficients[:kept]
    correction = correct_at(
        balance,
        balance.point(coefficients, guess.frequency),
        StepControl(tolerance=tolerance * _force_scale(problem)),
    )
    return _response(balance, correction, problem)


def _force_scale(problem: Problem) -> float:
    """Return the smaller of preload and drive, of those that act [N]."""
    sizes = [np.abs(load).max(initial=0.0) for load in (problem.preload, problem.drive)]
    return float(min((size for size in sizes if size > 0.0), default=1.0))


def _metric(means: int, frequency_scale: float) -> Metric:
    """Measure arc by relative changes of mean motion and vibration, and by frequency.

    The first ``means`` unknowns are mean values: a preload makes them large, and must
    not hide the vibration.
    """

    def metric(point: Array) -> Array:
        scale = np.full(point.size, float(np.linalg.norm(point[means:-1])) + 1e-15)
        scale[:means] = float(np.linalg.norm(point[:means])) + 1e-15
        scale[-1] = frequency_scale
        return scale

    return metric


def _response(
    balance: HarmonicBalance, correction: Correction, problem: Problem
) -> PeriodicResponse:
    coefficients, frequency = balance.split(correction.point)
    drift = balance.drift_force(correction.point)
    if drift > 1e-6 * _force_scale(problem):
        raise ContinuationError(
            f"a body drifts at {frequency:.6g} rad/s: friction has a mean of "
            f"{drift:.2g} N and nothing holds the body; give it a rope"
        )
    cycle = balance.contact.cycle(coefficients, frequency)
    return PeriodicResponse(
        frequency,
        balance.motion(correction.point),
        cycle.normal_smallest,
        cycle.normal_largest,
        cycle.friction,
        cycle.normal_damping,
        correction.residuals[-1],
        correction.outcome.name.lower(),
        correction.iterations,
    )
