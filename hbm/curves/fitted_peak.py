"""Where an amplitude is largest, by a polynomial through responses about it (§6.7).

Samples know the moments of slip and touch to whole samples: amplitudes are right to
second order in their distance, but only to first how they grow along a curve, and a
flat top is easily missed by that.
"""

from __future__ import annotations

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
"""how far about a peak responses are looked at, over its frequency: the first that
does"""
PLACES, DEGREE = np.linspace(-1.0, 1.0, 9), 4
"""of the responses, over the reach, and of the polynomial in them"""
SAMPLES = 4096
"""of each response"""
MISSED, FLAT = 1e-3, 1e-4
"""by how much the polynomial may miss an amplitude, over the drop to the ends, and the
drop over the amplitude that is needed for it"""
LOWER = 1e-3
"""than the known peak, relative: from which on a response lies on another branch"""


def fitted_peak(
    problem: Problem, rest: StaticState, peak: PeriodicResponse
) -> PeriodicResponse:
    """Return the response of largest amplitude about a peak that is roughly known.

    It has as many harmonics. Where the amplitude is no smooth function of the
    frequency, as at a bent peak, the known one is returned.
    """
    for reach in REACHES:
        try:
            found = _fitted(problem, rest, peak, reach)
        except ContinuationError:
            continue
        if found is not None:
            return found
    return peak


def _fitted(
    problem: Problem, rest: StaticState, peak: PeriodicResponse, reach: float
) -> PeriodicResponse | None:
    """Return it by responses within a reach; None if no polynomial has their top.

    Raises
    ------
    ContinuationError
        If one of them does not converge.
    """

    def at(place: float) -> PeriodicResponse:
        beside = replace(peak, frequency=(1.0 + reach * place) * peak.frequency)
        return periodic_response(
            problem, rest, beside, harmonics=peak.harmonics, samples=SAMPLES
        )

    top = _top(np.array([_size(problem, at(place)) for place in PLACES]))
    if top is None:
        return None
    found = at(top)
    if _size(problem, found) < (1.0 - LOWER) * _size(problem, peak):
        return None
    return replace(found, event=peak.event, parameter=found.frequency)


def _top(sizes: Array) -> float | None:
    """Return the place of the largest of amplitudes; None if they have no clear top."""
    fit = Polynomial.fit(PLACES, sizes, DEGREE)
    drop = float(sizes.max() - sizes[[0, -1]].max())
    missed = float(np.abs(fit(PLACES) - sizes).max())
    if drop < FLAT * sizes.max() or missed > MISSED * drop:
        return None
    turns = fit.deriv().roots()
    places = turns.real[(turns.imag == 0.0) & (np.abs(turns.real) < 1.0)]
    return float(places[fit(places).argmax()]) if places.size else None


def _size(problem: Problem, response: PeriodicResponse) -> float:
    """Return the largest first harmonic of a probe [m]."""
    return float(response.amplitudes(problem.probes.rows).max(initial=0.0))
