"""The public functions: from a problem to periodic responses along frequency."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from threadpoolctl import threadpool_limits

from hbm.active import extended, moving, symmetric
from hbm.adaptive import AdaptiveBalance, Resolution
from hbm.continuation import StepControl, correct_at
from hbm.curve import Curve, response
from hbm.fourier import FourierBasis
from hbm.pieces import Pieces
from hbm.relative import RelativeProblem, relative_problem
from hbm.residual import HarmonicBalance
from hbm.stability import small_motions
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.reduction import reduced
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState

RESOLVED = 16.0
"""a sparse structure is resolved up to this multiple of the excitation frequency"""


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
    highest: float | None = None
    """frequency up to which a sparse structure is resolved [rad/s], see
    :func:`~microslip_mechanics.reduction.reduced`; 16 × the larger end if left out"""

    def __post_init__(self) -> None:
        """Check the range."""
        if not (0.0 < self.start < np.inf and 0.0 < self.end < np.inf) or (
            self.start == self.end
        ):
            raise ValueError(
                f"frequencies {self.start:g} and {self.end:g} rad/s: "
                "give two different positive ones"
            )
        for name in ("error", "tolerance", "largest_step", "highest"):
            value = getattr(self, name)
            if value is not None and not 0.0 < value < np.inf:
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
    ends = max(options.start, options.end)
    small, still, shapes = _small(problem, rest, options.highest or RESOLVED * ends)
    relative, active = _moving(small, still, options.start)
    resolution = Resolution(relative, active, small.probes.rows)
    system = AdaptiveBalance(
        resolution,
        options.first,
        tolerance=None if options.harmonics else options.error,
    )
    motions = small_motions(small) if options.stability else None
    curve = Curve(problem, system, resolution, control, motions)
    pieces = Pieces(relative, active, system, options.start, options.end, control)
    with threadpool_limits(1, "blas"):
        for made in curve.followed(pieces, pieces.metric):
            yield replace(made, shapes=shapes)


def _small(
    problem: Problem, rest: StaticState, highest: float
) -> tuple[Problem, StaticState, Array | None]:
    """Return a problem with a dense structure, its rest, and what its columns move.

    The last is None if the structure has been dense before.
    """
    if not problem.structure.sparse:
        return problem, rest, None
    reduction = reduced(problem, highest)
    state = replace(rest, displacement=reduction.coordinates(rest.displacement))
    return reduction.problem, state, reduction.shapes


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
    highest: float | None = None,
) -> PeriodicResponse:
    """Return the response at the frequency of ``guess`` with another resolution.

    A sparse structure is reduced anew, up to ``highest`` as in :class:`CurveOptions`.

    Raises
    ------
    ContinuationError
        If the point does not converge.
    """
    control = StepControl(tolerance=tolerance * problem.force_scale)
    highest = highest or RESOLVED * guess.frequency
    small, still, shapes = _small(problem, rest, highest)
    relative, active = _moving(small, still, guess.frequency)
    fourier = FourierBasis(harmonics, samples)
    balance = HarmonicBalance(relative, fourier, extended(active, harmonics))
    rows = relative.basis.T @ problem.interface.displacement
    start = balance.point(guess.seen(rows), guess.frequency)
    with threadpool_limits(1, "blas"):
        correction = correct_at(balance, start, control)
    return replace(response(problem, balance, correction), shapes=shapes)
