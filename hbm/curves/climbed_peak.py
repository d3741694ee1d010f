"""The largest amplitude near a response, by other frequencies beside it (§6.7)."""

from __future__ import annotations

from dataclasses import replace

from hbm.curves.fitted_peak import fitted_peak
from hbm.curves.periodic_response import periodic_response
from hbm.errors import ContinuationError
from microslip_mechanics.arrays import Array
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState

FIRST, LAST = 4e-3, 1e-5
"""steps, over the frequency"""
MOST = 60
"""steps that are tried"""
ELSEWHERE = 0.2
"""growth in a step, from which a response may be that of another branch"""
NEAR, SHARP = 1e-3, 1e-2
"""relative distance of frequencies in which the amplitude drops by so much, relative,
to either side of a sharp peak, which needs no polynomial"""


def climbed_peak(
    problem: Problem, rest: StaticState, known: PeriodicResponse
) -> PeriodicResponse:
    """Return the response of largest amplitude to which growing ones lead from one.

    It has as many harmonics. Steps along the frequency that do not lead to larger
    amplitudes are halved; where there is no response, as behind a fold, none is larger.
    The place of a flat top is that of :func:`~hbm.curves.fitted_peak.fitted_peak`.
    """
    probes = problem.probes.rows
    best, step, way, left = known, FIRST, 1.0, MOST
    while step >= LAST and left > 0:
        left -= 1
        for side in (way, -way):
            found = _beside(problem, rest, best, 1.0 + side * step)
            if found is not None and 1.0 < _ratio(probes, found, best) < 1 + ELSEWHERE:
                best, way = found, side
                break
        else:
            step *= 0.5
    best = replace(best, event=known.event)
    return best if _sharp(problem, rest, best) else fitted_peak(problem, rest, best)


def _sharp(problem: Problem, rest: StaticState, peak: PeriodicResponse) -> bool:
    """Return whether amplitudes drop to both sides by what no rounding does."""
    sides = [_beside(problem, rest, peak, 1.0 + way * NEAR) for way in (-1.0, 1.0)]
    probes = problem.probes.rows
    return all(
        each is None or _ratio(probes, each, peak) < 1.0 - SHARP for each in sides
    )


def _ratio(probes: Array, one: PeriodicResponse, other: PeriodicResponse) -> float:
    """Return the largest amplitude of a probe over that of another response."""
    sizes = [each.largest(probes) for each in (one, other)]
    return sizes[0] / (sizes[1] or 1.0)


def _beside(
    problem: Problem, rest: StaticState, known: PeriodicResponse, factor: float
) -> PeriodicResponse | None:
    """Return the response at ``factor`` times the frequency; None if there is none."""
    guess = replace(known, frequency=factor * known.frequency)
    try:
        return periodic_response(
            *(problem, rest, guess), harmonics=known.harmonics, samples=known.samples
        )
    except ContinuationError:
        return None
