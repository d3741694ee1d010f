"""Where an amplitude is largest, by a polynomial through responses about it (§6.7).

Samples know the moments of slip and touch to whole samples: amplitudes are right to
second order in their distance, but only to first how they grow along a curve, and a
flat top is easily missed by that.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.polynomial import Polynomial

from hbm.curves.periodic_response import periodic_response
from hbm.errors import ContinuationError
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState

REACHES = (1e-2, 3e-3, 1e-3, 3e-4)
"""how far about a peak responses are looked at, over its frequency"""
PLACES, DEGREE = np.linspace(-1.0, 1.0, 9), 4
"""of the responses, over the reach, and of the polynomial in them"""
SAMPLES = 4096
"""of each response"""
SURE, MISSED, FLAT = 1e-3, 1e-2, 1e-4
"""by how much a polynomial may miss an amplitude, over the drop to the ends: the first
one that does by less than that, else the best of all; and the drop over the amplitude
that is needed for it"""
LOWER = 1e-3
"""than the known peak, relative: from which on a response lies on another branch"""


def fitted_peak(
    problem: Problem, rest: StaticState, peak: PeriodicResponse
) -> PeriodicResponse:
    """Return the response of largest amplitude about a peak that is roughly known.

    It has as many harmonics. Where the amplitude is no smooth function of the
    frequency, as at a bent peak, the known one is returned.
    """
    least, factor = MISSED, 1.0
    for reach in REACHES:
        try:
            missed, top = _top(_sizes(problem, rest, peak, reach))
        except ContinuationError:
            continue
        if missed < least:
            least, factor = missed, 1.0 + reach * top
        if least <= SURE:
            break
    try:
        found = _beside(problem, rest, peak, factor)
    except ContinuationError:
        return peak
    sizes = [each.largest(problem.probes.rows) for each in (found, peak)]
    if least == MISSED or sizes[0] < (1.0 - LOWER) * sizes[1]:
        return peak
    return replace(found, event=peak.event, parameter=found.frequency)


def _sizes(
    problem: Problem, rest: StaticState, peak: PeriodicResponse, reach: float
) -> Array:
    """Return the amplitudes of responses within a reach [m].

    Raises
    ------
    ContinuationError
        If one of them does not converge.
    """
    beside = (_beside(problem, rest, peak, 1.0 + reach * place) for place in PLACES)
    return np.array([each.largest(problem.probes.rows) for each in beside])


def _beside(
    problem: Problem, rest: StaticState, peak: PeriodicResponse, factor: float
) -> PeriodicResponse:
    """Return the response at ``factor`` times the frequency.

    Raises
    ------
    ContinuationError
        If it does not converge.
    """
    guess = replace(peak, frequency=factor * peak.frequency)
    return periodic_response(
        problem, rest, guess, harmonics=peak.harmonics, samples=SAMPLES
    )


def _top(sizes: Array) -> tuple[float, float]:
    """Return how a polynomial misses amplitudes, and the place of its largest value.

    It misses by infinity if there is no clear top.
    """
    fit = Polynomial.fit(PLACES, sizes, DEGREE)
    drop = float(sizes.max() - sizes[[0, -1]].max())
    turns = fit.deriv().roots()
    places = turns.real[(turns.imag == 0.0) & (np.abs(turns.real) < 1.0)]
    if drop < FLAT * sizes.max() or not places.size:
        return math.inf, 0.0
    missed = float(np.abs(fit(PLACES) - sizes).max())
    return missed / drop, float(places[fit(places).argmax()])
