"""The public functions: from a problem to periodic responses along frequency."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from hbm.adaptive import AdaptiveBalance, Resolution
from hbm.continuation import correct_at
from hbm.curve import Curve, response
from hbm.fourier import FourierBasis
from hbm.path import along_frequency
from hbm.pieces import Pieces
from hbm.stability import small_motions
from hbm.step_control import StepControl
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
    stability: bool = True
    """whether Floquet multipliers are computed"""

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
        tolerance=options.tolerance * problem.force_scale,
        initial=min(0.02, options.largest_step),
        largest=options.largest_step,
    )
    path = along_frequency(problem, rest, options.start, options.end)
    resolution = Resolution(path, problem.probes.rows)
    system = AdaptiveBalance(
        resolution,
        options.first,
        tolerance=None if options.harmonics else options.error,
    )
    motions = small_motions(problem) if options.stability else None
    curve = Curve(problem, system, resolution, control, motions)
    pieces = Pieces(path, system, options.start, options.end, control)
    with threadpool_limits(1, "blas"):
        yield from curve.followed(pieces, pieces.metric)


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
    control = StepControl(tolerance=tolerance * problem.force_scale)
    path = along_frequency(problem, rest, guess.frequency, guess.frequency)
    balance = path.balance(FourierBasis(harmonics, samples))
    relative = guess.coefficients @ path.problem.selection.T
    start = balance.point(relative, guess.frequency)
    with threadpool_limits(1, "blas"):
        correction = correct_at(balance, start, control)
    return response(problem, balance, correction)
