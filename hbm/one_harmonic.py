"""Responses with one harmonic, and how far from more harmonics they are (§6.7)."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np

from hbm.curves.across_curve import responses_across
from hbm.curves.climbed_peak import climbed_peak
from hbm.curves.fitted_peak import fitted_peak
from hbm.curves.periodic_response import periodic_response
from hbm.errors import ContinuationError, hertz
from hbm.forces.equivalent import SAMPLES
from hbm.forces.fourier import usual_samples
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState

ORDERS = (3, 7, 15, 31, 63, 127)
"""harmonics with which a one-harmonic response is solved again"""
DETOUR = 15
"""harmonics of the curve that leads there if that fails"""
ELSEWHERE = 0.3
"""distance from which a response may be that of another branch"""


class OneHarmonicError(NamedTuple):
    """How far a response is from that with more harmonics; NaN if none was found."""

    amplitude: float
    """largest difference of the probes' amplitudes, over the largest amplitude"""
    frequency: float
    """relative; zero if it was to be the same, NaN too if none of another was found"""


def one_harmonic_response(
    problem: Problem,
    rest: StaticState,
    limits: tuple[float, float],
    frequency: float | None = None,
) -> PeriodicResponse:
    """Return the response with mean and first harmonic at one frequency.

    Parameters
    ----------
    problem, rest
        What is solved, and its static equilibrium.
    limits
        Range of excitation frequencies [rad/s] in which the curve is traced.
    frequency
        Where the response is wanted [rad/s]; at the largest amplitude if left out.

    Raises
    ------
    ContinuationError
        If the curve does not get there.
    """
    start, end = limits
    if frequency is not None:
        start, end = _towards(frequency, limits), frequency
    options = CurveOptions(
        start, end, harmonics=1, samples=SAMPLES, stability=False, errors=False
    )
    curve = frequency_response(problem, rest, options)
    if frequency is not None:
        return _met(curve, frequency)
    best = max(curve, key=lambda each: each.largest(problem.probes.rows))
    return fitted_peak(problem, rest, best) if best.event == "peak" else best


def one_harmonic_error(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    limits: tuple[float, float],
    tolerance: float,
    *,
    free: bool = False,
) -> OneHarmonicError:
    """Return how far a response is from that with more harmonics.

    Parameters
    ----------
    problem, rest, response
        What is solved, its static equilibrium, and the one-harmonic response.
    limits
        Range [rad/s] of its curve.
    tolerance
        Relative change of the amplitude from which more harmonics are taken.
    free
        Whether the frequency is free, as at a peak: the response is sought across the
        curve then, and from there the peak, else at its own frequency. If that leads
        elsewhere, the other way is tried.
    """
    across = responses_across(problem, rest, response, limits, ORDERS)
    at_frequency = _at_frequency(problem, rest, response, limits)
    ways = (across, at_frequency) if free else (at_frequency, across)
    for way in ways:
        try:
            better = _converged(problem, response, way, tolerance)
        except ContinuationError:
            continue
        if free and way is across and response.event == "peak":
            better = climbed_peak(problem, rest, better)
        apart = _distance(problem, response, better)
        if apart <= ELSEWHERE:
            known = not free or way is across
            shift = abs(response.frequency / better.frequency - 1.0)
            return OneHarmonicError(apart, shift if known else math.nan)
    return OneHarmonicError(math.nan, math.nan)


def _at_frequency(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    limits: tuple[float, float],
) -> Iterator[PeriodicResponse]:
    """Yield responses with more and more harmonics at the same frequency.

    Where Newton's iteration does not lead there, the end of a curve is the last one.

    Raises
    ------
    ContinuationError
        If that curve does not get there.
    """
    frequency = response.frequency
    try:
        for harmonics in ORDERS:
            response = periodic_response(
                *(problem, rest, response),
                harmonics=harmonics,
                samples=usual_samples(harmonics),
            )
            yield response
    except ContinuationError:
        start = _towards(frequency, limits)
        options = CurveOptions(
            start, frequency, harmonics=DETOUR, stability=False, errors=False
        )
        yield _met(frequency_response(problem, rest, options), frequency)


def _converged(
    problem: Problem,
    response: PeriodicResponse,
    finer: Iterable[PeriodicResponse],
    tolerance: float,
) -> PeriodicResponse:
    """Return the first of finer responses that hardly differs from the one before."""
    for better in finer:
        before, response = response, better
        if _distance(problem, before, response) <= tolerance:
            break
    return response


def _towards(frequency: float, limits: tuple[float, float]) -> float:
    """Return the limit from which a curve leads to a frequency."""
    return limits[0] if frequency > limits[0] else limits[1]


def _met(curve: Iterable[PeriodicResponse], frequency: float) -> PeriodicResponse:
    """Return the last response of a curve at a frequency, wherever the curve ends.

    Raises
    ------
    ContinuationError
        If the curve does not get there.
    """
    found: PeriodicResponse | None = None
    try:
        for each in curve:
            found = each if each.frequency == frequency else found
    except ContinuationError:
        if found is None:
            raise
    if found is None:
        raise ContinuationError(
            f"the curve does not pass {hertz(frequency)}: begin it nearer to there"
        )
    return found


def _distance(
    problem: Problem, response: PeriodicResponse, better: PeriodicResponse
) -> float:
    rows = problem.probes.rows
    found, reference = response.amplitudes(rows), better.amplitudes(rows)
    size = float(reference.max(initial=0.0)) or 1.0
    return float(np.abs(found - reference).max(initial=0.0)) / size
