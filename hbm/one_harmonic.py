"""Responses with one harmonic, and how far from more harmonics they are (theory §6)."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hbm.equivalent import SAMPLES
from hbm.errors import ContinuationError, hertz
from hbm.options import CurveOptions
from hbm.periodic_response import periodic_response
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.static import StaticState

ORDERS = (3, 7, 15, 31, 63, 127)
"""harmonics with which a one-harmonic response is solved again"""
DETOUR = 15
"""harmonics of the curve that leads there if that fails"""


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
    options = CurveOptions(start, end, harmonics=1, samples=SAMPLES, stability=False)
    curve = frequency_response(problem, rest, options)
    if frequency is not None:
        return _met(curve, frequency)
    return max(curve, key=lambda each: float(amplitudes(problem, each).max()))


def one_harmonic_error(
    problem: Problem,
    rest: StaticState,
    response: PeriodicResponse,
    limits: tuple[float, float],
    tolerance: float,
) -> float:
    """Return how far a response is from that with more harmonics at its frequency.

    Parameters
    ----------
    problem, rest, response
        What is solved, its static equilibrium, and the one-harmonic response.
    limits
        Range [rad/s] of the curve that leads to the response, if Newton's iteration
        from the one-harmonic response does not.
    tolerance
        Relative change of the amplitude from which more harmonics are taken.

    Returns
    -------
    Largest difference of the probes' amplitudes, over the largest amplitude; NaN if no
    response with more harmonics was found.
    """
    try:
        better = _solved_again(problem, rest, response, tolerance)
    except ContinuationError:
        start = _towards(response.frequency, limits)
        options = CurveOptions(
            start, response.frequency, harmonics=DETOUR, stability=False
        )
        try:
            better = _met(
                frequency_response(problem, rest, options), response.frequency
            )
        except ContinuationError:
            return float("nan")
    return _distance(problem, response, better)


def amplitudes(problem: Problem, response: PeriodicResponse) -> Array:
    """Return the first harmonic of each probe [m], shape (probes,)."""
    seen = response.seen(problem.probes.rows)[1:3]
    found: Array = np.hypot(*seen)
    return found


def _solved_again(
    problem: Problem, rest: StaticState, response: PeriodicResponse, tolerance: float
) -> PeriodicResponse:
    """Return the response with as many harmonics as the tolerance asks for."""
    for harmonics in ORDERS:
        before = response
        response = periodic_response(
            problem, rest, before, harmonics=harmonics, samples=16 * (harmonics + 1)
        )
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
    found, reference = amplitudes(problem, response), amplitudes(problem, better)
    size = float(reference.max(initial=0.0)) or 1.0
    return float(np.abs(found - reference).max(initial=0.0)) / size
