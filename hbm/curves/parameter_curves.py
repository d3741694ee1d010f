"""Curves along another parameter than the frequency: responses, and folds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np

from hbm.curves.fold_curve import FoldCurve, FoldPoint
from hbm.curves.tracer import Tracer
from hbm.one_thread import one_thread
from hbm.options import CurveOptions
from hbm.paths.along_parameter import AlongParameter
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse


def parameter_response(
    problem_at: Callable[[float], Problem], frequency: float, options: CurveOptions
) -> Iterator[PeriodicResponse]:
    """Yield the periodic responses at one frequency along a parameter, through folds.

    Parameters
    ----------
    problem_at
        Value of the parameter ↦ what is solved.
    frequency
        Of the excitation [rad/s].
    options
        Range of the parameter, accuracy, harmonics.

    Raises
    ------
    ContinuationError
        If the curve cannot go on; what was yielded before stays valid.
    ValueError
        If the frequency is not positive.
    """
    path = AlongParameter(problem_at, frequency, options.start, options.end)
    tracer = Tracer(_driven(problem_at, options), path, options)
    least, most = sorted((options.start, options.end))
    with one_thread():
        for response in tracer.responses():  # rounding may leave the range at its ends
            inside = float(np.clip(response.parameter, least, most))
            yield replace(response, parameter=inside)


def fold_curve(
    problem_at: Callable[[float], Problem],
    fold: PeriodicResponse,
    options: CurveOptions,
) -> Iterator[FoldPoint]:
    """Yield the folds into which a fold of a frequency response curve moves.

    Parameters
    ----------
    problem_at
        Value of the parameter ↦ what is solved.
    fold
        Of the curve at ``options.start``, as it was located.
    options
        Range of the parameter, harmonics; left open, those of the fold, at most
        :data:`~hbm.curves.fold_curve.HARMONICS`.

    Raises
    ------
    ContinuationError
        If the fold is lost; what was yielded before stays valid.
    """
    path = AlongParameter(problem_at, fold.frequency, options.start, options.end)
    with one_thread():
        problem = _driven(problem_at, options)
        yield from FoldCurve(problem, path, options, fold).points()


def _driven(problem_at: Callable[[float], Problem], options: CurveOptions) -> Problem:
    """Return the problem at the end of a range, at its beginning if nothing drives it.

    Its loads say what is large.
    """
    last = problem_at(options.end)
    return last if last.drive.any() else problem_at(options.start)
