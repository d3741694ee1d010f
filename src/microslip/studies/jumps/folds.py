"""Folds of a curve from which a stable motion jumps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from microslip.studies.curve import Traced
from microslip.studies.verify.verify import StudyError
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.moving_probe import moving_probe
from microslip_mechanics.results.response import BEGINNINGS, PeriodicResponse

BEYOND = 1e-4
"""of a fold's frequency, by which one looks behind it for where the motion lands"""

NEAR = 1e-3
"""of a fold's frequency, within which a motion before it may seem unstable: where a
slider turns over, multipliers pass 1 beside the fold"""


@dataclass(frozen=True, slots=True)
class Fold:
    """A fold of a curve at which a stable motion ends."""

    response: PeriodicResponse
    upward: bool
    """whether a sweep upwards ends there, rather than one downwards"""
    begin: PeriodicResponse
    """a stable motion on the way to it"""
    end: float
    """frequency behind it to which sweeps go [Hz]"""
    height: float
    """amplitude of a probe half way to where the motion lands [m]"""
    falls: bool
    """whether it is smaller there"""
    probe: int
    """which one: the first whose amplitude jumps"""

    @property
    def hertz(self) -> float:
        """Its frequency [Hz]."""
        return self.response.frequency / (2.0 * np.pi)

    @property
    def error(self) -> float:
        """Estimated error of that [Hz]; 0 if it is not known."""
        told = self.response.parameter_error / (2.0 * np.pi)
        return told if np.isfinite(told) else 0.0


def folds_of(problem: Problem, traced: Traced, *, lead: float) -> list[Fold]:
    """Return the folds of a curve from which a stable motion jumps.

    Parameters
    ----------
    problem
        What was traced.
    traced
        The curve.
    lead
        How far behind the fold sweeps end, over the fold's frequency; they begin as far
        before it, or where the stable motion begins.

    Raises
    ------
    StudyError
        If the stability of the curve is not known.
    """
    if any(each.event == "fold" and each.unstable < 0 for each in traced.responses):
        raise StudyError(
            "the curve has folds, but its stability is not known: sweep through them "
            "by microslip sweep"
        )
    found = []
    for place, response in enumerate(traced.responses):
        if response.event != "fold":
            continue
        begin = _begin(traced.responses, place, lead)
        if begin is not None:
            upward = begin.frequency < response.frequency
            way = _way(traced.responses, place, begin)
            landing = _landing(problem, traced, response, way, upward=upward)
            if landing is not None:
                share = 1.0 + (lead if upward else -lead)
                end = share * response.frequency / (2.0 * np.pi)
                found.append(Fold(response, upward, begin, end, *landing))
    return found


def _begin(
    responses: Sequence[PeriodicResponse], place: int, lead: float
) -> PeriodicResponse | None:
    """Return the stable motion, at most ``lead`` away, from which one comes to a fold.

    None if neither side of the fold is stable.
    """
    fold = responses[place].frequency
    for near in (0.0, NEAR * fold):
        for side in _sides(responses, place):
            begin = _stable(side, fold, lead * fold, near)
            if begin is not None:
                return begin
    return None


def _stable(
    side: Sequence[PeriodicResponse], fold: float, lead: float, near: float
) -> PeriodicResponse | None:
    """Return the last stable motion on one side that a sweep to the fold passes.

    Unstable ones nearer than ``near`` [rad/s] are left out.
    """
    begin = None
    for each in side:
        away = abs(each.frequency - fold)
        if begin is None and each.unstable > 0 and each.event != "fold" and away < near:
            continue
        other = each.event not in ("", "peak", *BEGINNINGS)
        if each.unstable != 0 or (other and begin is not None):
            break
        begin = each
        if away >= lead:
            break
    return begin


def _sides(
    responses: Sequence[PeriodicResponse], place: int
) -> tuple[Sequence[PeriodicResponse], Sequence[PeriodicResponse]]:
    """Return what lies before and behind a point of its piece, nearest first."""
    begins = [
        n for n, each in enumerate(responses) if n == 0 or each.event in BEGINNINGS
    ]
    first = max(begin for begin in begins if begin <= place)
    last = min((n for n in begins if n > place), default=len(responses))
    return responses[first:place][::-1], responses[place + 1 : last]


def _way(
    responses: Sequence[PeriodicResponse], place: int, begin: PeriodicResponse
) -> range:
    """Return the places from a stable motion to the fold that it comes to."""
    begun = next(n for n, each in enumerate(responses) if each is begin)
    return range(min(begun, place), max(begun, place))


def _landing(
    problem: Problem,
    traced: Traced,
    fold: PeriodicResponse,
    way: range,
    *,
    upward: bool,
) -> tuple[float, bool, int] | None:
    """Return half way between the fold and the stable motion behind it [m].

    And whether that one is smaller, and of which probe this is told; None if there is
    no such motion. It does not lie on the ``way`` to the fold, whose last points may be
    behind that by their errors.
    """
    behind = fold.frequency * (1.0 + (BEYOND if upward else -BEYOND))
    frequency, seen = traced.curve.frequency, traced.curve.amplitude
    here = np.hypot(*fold.seen(problem.probes.rows)[1:3])
    landings = []
    for first in range(len(frequency) - 1):
        if first in way or traced.curve.event[first + 1] in BEGINNINGS:
            continue  # the latter begin another piece
        low, high = frequency[first : first + 2]
        stable = traced.curve.unstable[first : first + 2].max() <= 0
        if stable and (low - behind) * (high - behind) <= 0.0 and low != high:
            share = (behind - low) / (high - low)
            landings.append(seen[first] + share * (seen[first + 1] - seen[first]))
    if not landings:
        return None
    landing = min(landings, key=lambda each: np.abs(each - here).max())
    probe = moving_probe(landing - here)
    height = 0.5 * float(here[probe] + landing[probe])
    return height, bool(landing[probe] < here[probe]), probe
