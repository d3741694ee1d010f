"""The curve of a case under stress: to its tolerance, or with few harmonics in time."""

from __future__ import annotations

import contextlib
import math
from dataclasses import replace
from typing import NamedTuple

from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.scenes.experiments import Curve
from microslip.studies.clock import LATE, Clock, OutOfTimeError
from microslip.studies.curve import Traced, curve_options, trace_curve, traced_of
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium

TRACING, COARSE = 0.5, 0.68
"""shares of a case's time after which a curve, and the one instead of it, is left"""
FEW = 7
"""harmonics of that one"""


class Drawn(NamedTuple):
    """A curve that was traced in time."""

    traced: Traced
    said: str = ""
    """why it is not the one that was asked for"""
    options: CurveOptions | None = None
    """with which it was; none if it is not the one"""


def drawn(problem: Problem, curve: Curve, clock: Clock) -> Drawn:
    """Return the curve; where it is out of time, one of few harmonics that is not.

    Neither has multipliers: those of the orbits that are compared are enough. The
    error of few harmonics, which is not estimated, is infinite. If they are out of time
    too, or given, what there is of the first is returned.

    Raises
    ------
    ContinuationError
        If the curve does not begin.
    OutOfTimeError
        If no curve has begun in time.
    """
    traced: Traced | None = None
    with contextlib.suppress(OutOfTimeError), clock.until(TRACING):
        traced = trace_curve(problem, curve, stability=False)
    late = traced is None or traced.curve.ending == LATE
    if late and curve.harmonics is None:
        coarse = _coarse(problem, replace(curve, harmonics=FEW), clock)
        if coarse is not None:
            return Drawn(coarse, f"{LATE}; with {FEW} harmonics instead")
    if traced is None:
        raise OutOfTimeError(LATE)
    return Drawn(traced, options=curve_options(curve))


def _coarse(problem: Problem, curve: Curve, clock: Clock) -> Traced | None:
    """Return a curve of fixed harmonics if it is whole in time."""
    rest = static_equilibrium(problem)
    options = replace(curve_options(curve), errors=False, stability=False)
    responses = frequency_response(problem, rest, options)
    unsure = (replace(each, error=math.inf) for each in responses)
    try:
        with clock.until(COARSE):
            traced = traced_of(problem, rest, unsure, iter)
    except (ContinuationError, OutOfTimeError):
        return None
    return traced if traced.curve.ending == "complete" else None
