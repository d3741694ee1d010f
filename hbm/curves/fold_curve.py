"""The folds of frequency response curves along a second parameter (theory §6.4)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from hbm.balance.balance import Balance
from hbm.balance.parametric import mirrored
from hbm.balance.residual import HarmonicBalance
from hbm.balance.rigid import pushed
from hbm.continuation.continuation import trace
from hbm.continuation.correction import Correction
from hbm.continuation.effort import Effort
from hbm.continuation.segment import Segment, folds
from hbm.curves.response import response
from hbm.events.finer_fold import FinerFold
from hbm.events.fold_balance import FoldBalance, Inner, beyond
from hbm.forces.fourier import FourierBasis, usual_samples
from hbm.options import CurveOptions
from hbm.paths.along_parameter import AlongParameter
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import MARGIN, PeriodicResponse

HARMONICS = 63
"""most that are solved for, if their number is left open"""


@dataclass(frozen=True, slots=True)
class FoldPoint:
    """A fold of the frequency response curve at one value of the parameter."""

    response: PeriodicResponse
    """at the fold; its error is not estimated

    The event is "cusp" where two folds meet, "isola" where two curves do.
    """
    unstable: int
    """number of Floquet multipliers outside the unit circle besides the fold's own; −1
    if they are not known"""
    frequency_error: float
    """of the frequency, relative, seen with twice the harmonics; infinite if unknown"""
    parameter_error: float
    """of the parameter [its SI unit]; both belong to a move across the curve"""


class FoldCurve:
    """Follows one fold at a fixed number of harmonics and samples."""

    def __init__(
        self,
        problem: Problem,
        path: AlongParameter,
        options: CurveOptions,
        known: PeriodicResponse,
    ) -> None:
        """Plan for the fold near ``known``, a response at ``options.start``.

        ``path`` leads along the parameter, ``problem`` is one on it.
        """
        self._problem, self._path, self._options = problem, path, options
        self._fourier = _resolution(options, known)
        self._control = options.control(problem.force_scale)
        finer = self._fourier.doubled
        self._system, self._balance = self._planned(self._fourier)
        missing = (finer.coefficients - self._fourier.coefficients) * path.rank
        planned, _ = self._planned(finer)
        self._finer = FinerFold(planned, missing, self._control.tolerance)
        inner, _ = self._inner(self._balance, options.start)
        relative = known.seen(path.at(options.start)[0].selection)
        start = pushed(inner, inner.point(relative, known.frequency))
        self._start = np.append(start, options.start)

    def points(self) -> Iterator[FoldPoint]:
        """Yield the folds to the end of the range, or until they come back.

        Raises
        ------
        ContinuationError
            If a fold is lost, or the effort is spent; what was yielded before stays
            valid.
        """
        before: Correction | None = None
        effort = Effort(self._options.effort)
        for correction in trace(
            effort.counted(self._system, self._fourier.harmonics),
            self._start,
            self._options.end,
            metric=self._metric,
            control=self._control,
            settler=self._system,
        ):
            if before is not None:
                yield from self._turn(before, correction)
            yield self._made(correction, "")
            before = correction

    def _turn(self, before: Correction, after: Correction) -> Iterator[FoldPoint]:
        """Yield the extreme of the parameter between two points, if there is one."""
        scale, tolerance = self._metric(before.point), self._control.tolerance
        segment = Segment(self._system, before, after, scale, tolerance)
        located = segment.locate(folds)
        if located is not None:
            yield self._made(located, meeting(before, after))

    def _made(self, correction: Correction, event: str) -> FoldPoint:
        """Return the fold at a point, with its error."""
        point = correction.point
        parameter = float(point[-1])
        inner, _ = self._inner(self._balance, parameter)
        frequency_error, parameter_error = self._finer.errors(
            correction, self._metric(point)
        )
        made = response(self._problem, inner, replace(correction, point=point[:-1]))
        multipliers, others = self._multipliers(inner, parameter, float(point[-2]))
        return FoldPoint(
            replace(made, multipliers=multipliers, parameter=parameter, event=event),
            others,
            frequency_error,
            parameter_error,
        )

    def _multipliers(
        self, balance: HarmonicBalance, parameter: float, frequency: float
    ) -> tuple[ComplexArray, int]:
        """Return the multipliers, and how many besides the fold's own exceed one.

        Those of rigid contacts are not known.
        """
        if balance.problem.tractions is not None:
            return np.zeros(0, complex), -1
        motions = self._path.motions(parameter)
        multipliers = motions.multipliers(balance.contact, frequency)
        if multipliers.size == 0:
            return multipliers, -1
        others = np.delete(multipliers, np.abs(multipliers - 1.0).argmin())
        return multipliers, int((np.abs(others) > 1.0 + MARGIN).sum())

    def _planned(self, fourier: FourierBasis) -> tuple[FoldBalance, Balance]:
        """Return the extended system at one resolution, and what it extends."""
        balance = self._path.balance(fourier)
        places = np.flatnonzero(self._path.mask(fourier.harmonics))
        start, end = self._options.start, self._options.end
        limits = min(start, end), max(start, end)

        def at(parameter: float) -> Inner:
            border, image = mirrored(parameter, limits)
            here, _ = self._inner(balance, border)
            if border == parameter:
                return here
            return beyond(here, self._inner(balance, image)[0])

        return FoldBalance(at, self._path.unit, places, self._path.rank), balance

    @staticmethod
    def _inner(balance: Balance, parameter: float) -> tuple[HarmonicBalance, Array]:
        return balance.at_frequency(np.array([parameter]))

    def _metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc.

        Relative changes of mean motion and vibration each, a tenth of the frequency,
        and a tenth of the parameter's range.
        """
        rank, vibration = self._path.rank, self._system.vibration(point)
        scale = np.full(point.size, vibration)
        scale[:rank] = max(float(np.linalg.norm(point[:rank])), vibration)
        scale[-2:] = 0.1 * point[-2], self._path.unit(float(point[-1]))
        return scale


def meeting(before: Correction, after: Correction) -> str:
    """Return what happens between two folds of which the parameter turns.

    With the left null vector w of ∂R/∂y the tangent has wᵀ ∂R/∂ω ω' + wᵀ ∂R/∂λ λ' = 0.
    At a cusp, where two folds of one curve meet, ω turns together with λ. Otherwise
    wᵀ ∂R/∂ω is zero: the curve crosses itself or shrinks to a point there.
    """
    turns = before.along[-2] * after.along[-2] < 0.0
    return "cusp" if turns else "isola"


def _resolution(options: CurveOptions, known: PeriodicResponse) -> FourierBasis:
    """Return the resolution asked for, or that of a known response, if moderate."""
    if options.harmonics is not None:
        return options.first
    harmonics = min(known.harmonics, HARMONICS)
    return FourierBasis(harmonics, max(known.samples, usual_samples(harmonics)))
