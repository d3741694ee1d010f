"""The curve of a case under stress: to its tolerance, or with few harmonics in time."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import NamedTuple

from hbm.errors import ContinuationError
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip.experiments import Curve
from microslip.studies.curve import Traced, curve_options, gathered, trace_curve
from microslip.studies.stress_clock import Clock, OutOfTimeError, heeded
from microslip.studies.stress_finding import line
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import response_curve
from microslip_mechanics.static import static_equilibrium

TRACING, COARSE = 0.6, 0.71
"""shares of a case's time after which a curve, and the one instead of it, is left"""
FEW = 7
"""harmonics of that one"""
WHOLE = "complete"


class Drawn(NamedTuple):
    """A curve that was traced in time."""

    traced: Traced
    said: str = ""
    """why it is not the one that was asked for"""
    options: CurveOptions | None = None
    """with which it was; none if it is not the one"""


def drawn(problem: Problem, curve: Curve, clock: Clock) -> Drawn:
    """Return the curve; where it is not whole in time, one of few harmonics that is.

    Neither has multipliers: those of the orbits that are compared are enough. The
    error of few harmonics, which is not estimated, is infinite. If neither is whole,
    the first is what there is.

    Raises
    ------
    ContinuationError
        If the curve does not begin.
    OutOfTimeError
        If no curve has begun in time.
    """
    traced: Traced | None = None
    try:
        with clock.until(TRACING):
            traced = trace_curve(problem, curve, heeded, stability=False)
        said = traced.curve.ending
    except OutOfTimeError as error:
        said = line(error)
    if said == WHOLE or curve.harmonics is not None:
        return _there(traced, curve)
    coarse = _coarse(problem, replace(curve, harmonics=FEW), clock)
    if coarse is None:
        return _there(traced, curve)
    return Drawn(coarse, f"{said}; with {FEW} harmonics instead")


def _there(traced: Traced | None, curve: Curve) -> Drawn:
    if traced is None:
        raise OutOfTimeError("out of time")
    return Drawn(traced, options=curve_options(curve))


def _coarse(problem: Problem, curve: Curve, clock: Clock) -> Traced | None:
    """Return a curve of fixed harmonics if it is whole in time."""
    rest = static_equilibrium(problem)
    options = replace(curve_options(curve), errors=False, stability=False)
    try:
        with clock.until(COARSE):
            traced = heeded(frequency_response(problem, rest, options))
            responses, ending = gathered(traced)
    except (ContinuationError, OutOfTimeError):
        return None
    if ending != WHOLE:
        return None
    unsure = tuple(replace(each, error=math.inf) for each in responses)
    return Traced(response_curve(problem, unsure, ending), unsure, rest)
