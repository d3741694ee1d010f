"""The public functions: from a problem to periodic responses along frequency."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hbm.active import extended, moving, symmetric
from hbm.adaptive import AdaptiveBalance, Resolution
from hbm.continuation import (
    ContinuationError,
    Metric,
    StepControl,
    correct_at,
    trace,
)
from hbm.fourier import FourierBasis
from hbm.newton import Correction
from hbm.relative import RelativeProblem, relative_problem
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
    error: float = 1e-3
    """of the amplitude at each point, relative: harmonics and samples follow from it"""
    harmonics: int | None = None
    """fixed number instead"""
    samples: int | None = None
    """fixed number per period; 16 (harmonics + 1) if left out"""
    tolerance: float = 1e-8
    """largest unbalanced force over the smaller of preload and drive"""
    largest_step: float = 0.25
    """relative change of the response, or share of a tenth of the range"""

    def __post_init__(self) -> None:
        """Check the range."""
        if not (0.0 < self.start < np.inf and 0.0 < self.end < np.inf) or (
            self.start == self.end
        ):
            raise ValueError(
                f"frequencies {self.start:g} and {self.end:g} rad/s: "
                "give two different positive ones"
            )
        for name in ("error", "tolerance", "largest_step"):
            value = getattr(self, name)
            if not 0.0 < value < np.inf:
                raise ValueError(f"{name} {value:g}: give a positive number")
        if self.samples is not None and self.harmonics is None:
            raise ValueError("samples without harmonics: give both, or harmonics alone")

    @property
    def first(self) -> FourierBasis:
        """Resolution of the first point."""
        harmonics = self.harmonics or 1
        return FourierBasis(harmonics, self.samples or 16 * (harmonics + 1))


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
        Range, accuracy, harmonics.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    """
    control = StepControl(
        tolerance=options.tolerance * _force_scale(problem),
        initial=min(0.02, options.largest_step),
        largest=options.largest_step,
    )
    reduced, active = _moving(problem, rest, options.start)
    resolution = Resolution(reduced, active, problem.probes.rows)
    system = AdaptiveBalance(
        resolution,
        options.first,
        tolerance=None if options.harmonics else options.error,
    )
    start = np.zeros(system.size)
    start[: reduced.rank], start[-1] = reduced.rest, options.start
    for correction in trace(
        system,
        start,
        options.end,
        metric=_metric(reduced.rank, abs(options.end - options.start) / 10.0),
        control=control,
        settler=system,
    ):
        point, fourier, error = system.kept(correction.point)
        balance = resolution.at(fourier)
        yield _response(balance, replace(correction, point=point), problem, error)


def _moving(
    problem: Problem, rest: StaticState, frequency: float
) -> tuple[RelativeProblem, NDArray[np.bool_]]:
    """Return the problem without what a symmetry keeps still, and its active orders."""
    whole = relative_problem(problem, rest)
    active = moving(whole, frequency)
    kept, odd = symmetric(active)
    return whole.restricted(kept, odd), active[:, kept]


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
    control = StepControl(tolerance=tolerance * _force_scale(problem))
    reduced, active = _moving(problem, rest, guess.frequency)
    fourier = FourierBasis(harmonics, samples)
    balance = HarmonicBalance(reduced, fourier, extended(active, harmonics))
    start = balance.point(guess.coefficients @ reduced.selection.T, guess.frequency)
    correction = correct_at(balance, start, control)
    return _response(balance, correction, problem, math.inf)


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
    balance: HarmonicBalance, correction: Correction, problem: Problem, error: float
) -> PeriodicResponse:
    drift = balance.drift_force(correction.point)
    frequency = float(correction.point[-1])
    if drift > 1e-6 * _force_scale(problem):
        raise ContinuationError(
            f"a body drifts at {frequency:.6g} rad/s: friction has a mean of "
            f"{drift:.2g} N and nothing holds the body; give it a rope"
        )
    cycle = balance.cycle(correction.point)
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
        balance.fourier.harmonics,
        balance.fourier.samples,
        error,
    )
