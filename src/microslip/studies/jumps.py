"""Where a swept sine jumps, extrapolated to an infinitely slow sweep.

A sweep that passes a fold at the rate r jumps late by a delay that goes like r^(2/3):
near a saddle-node x' = r t + x² escapes where the first zero of Airy's function lies
(Haberman, SIAM J. Appl. Math. 37, 1979; Jung, Gray, Roy & Mandel, Phys. Rev. Lett. 65,
1990). The time that the motion then takes to fall adds a term like r.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from microslip.studies.curve import Traced
from microslip.studies.verify import StudyError, envelope_of
from microslip_mechanics.arrays import Array
from microslip_mechanics.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.response import PeriodicResponse
from microslip_mechanics.time_history import joined
from timedomain.integrate import MarchOptions, integrate
from timedomain.start import on_orbit

LEAST = 4
"""rates: three unknowns of the fit, and one to judge it by"""
ROWS = 20
"""stored per period"""
BEYOND = 1e-4
"""of a fold's frequency, by which one looks behind it for where the motion lands"""


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
    """amplitude of the first probe half way to where the motion lands [m]"""

    @property
    def hertz(self) -> float:
        """Its frequency [Hz]."""
        return self.response.frequency / (2.0 * np.pi)


@dataclass(frozen=True, slots=True)
class Jump:
    """Where sweeps of several rates jump, and what follows for a slow one."""

    fold: Fold
    rates: Array
    """[Hz/s], shape (rates,)"""
    frequency: Array
    """at which the envelope has fallen or risen half way [Hz], shape (rates,)"""
    extrapolated: float
    """to no rate [Hz]"""
    error: float
    """of that, see :func:`extrapolated` [Hz]"""
    envelopes: tuple[tuple[Array, Array], ...]
    """frequency [Hz] and largest deflection [m] of each cycle, for each rate"""


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
        if response.event != "fold" or not 0 < place < len(traced.responses) - 1:
            continue
        begin = _begin(traced.responses, place, lead)
        if begin is not None:
            upward = begin.frequency < response.frequency
            height = _height(problem, traced, response, upward=upward)
            if height is not None:
                share = 1.0 + (lead if upward else -lead)
                end = share * response.frequency / (2.0 * np.pi)
                found.append(Fold(response, upward, begin, end, height))
    return found


def jumps(
    problem: Problem, folds: Sequence[Fold], rates: Sequence[float], *, steps: int = 600
) -> Iterator[Jump]:
    """Yield the jump at each fold.

    Parameters
    ----------
    problem
        What is marched, with ``steps`` per period.
    folds
        Of its curve.
    rates
        Of the sweeps [Hz/s], at least :data:`LEAST` different ones.

    Raises
    ------
    StudyError
        If a sweep does not jump before its end.
    """
    if len(set(rates)) < LEAST:
        raise StudyError(f"{len(set(rates))} rates: give at least {LEAST} different")
    ordered = np.array(sorted(set(rates), reverse=True))
    for fold in folds:
        envelopes = tuple(_swept(problem, fold, rate, steps) for rate in ordered)
        places = np.array([_passed(fold, *envelope) for envelope in envelopes])
        yield Jump(fold, ordered, places, *extrapolated(ordered, places), envelopes)


def extrapolated(rates: Array, frequency: Array) -> tuple[float, float]:
    """Return f₀ of f = f₀ + a r^(2/3) + b r by least squares, and its error.

    The error is the larger of the fit's standard error, which the scatter of jumps
    makes, and of what leaving the fastest sweep out changes, where terms that the law
    does not have are largest.
    """
    found, error = _fitted(rates, frequency)
    slower = rates < rates.max()
    without, _ = _fitted(rates[slower], frequency[slower])
    return found, max(error, abs(found - without))


def _fitted(rates: Array, frequency: Array) -> tuple[float, float]:
    """Return f₀ and its standard error; zero where three jumps fix the fit."""
    scaled = rates / rates.max()
    terms = np.stack([np.ones_like(scaled), scaled ** (2.0 / 3.0), scaled], axis=1)
    found, *_ = np.linalg.lstsq(terms, frequency)
    away = frequency - terms @ found
    variance = float(away @ away) / max(1, len(rates) - terms.shape[1])
    spread = np.linalg.inv(terms.T @ terms)[0, 0]
    return float(found[0]), float(np.sqrt(variance * spread))


def _begin(
    responses: Sequence[PeriodicResponse], place: int, lead: float
) -> PeriodicResponse | None:
    """Return the stable motion, at most ``lead`` away, from which one comes to a fold.

    None if neither side of the fold is stable.
    """
    fold = responses[place].frequency
    for step in (-1, 1):
        begin, at = None, place + step
        while 0 <= at < len(responses) and responses[at].unstable == 0:
            if begin is not None and responses[at].event not in ("", "peak"):
                break
            begin, at = responses[at], at + step
            if abs(begin.frequency - fold) >= lead * fold:
                break
        if begin is not None:
            return begin
    return None


def _height(
    problem: Problem, traced: Traced, fold: PeriodicResponse, *, upward: bool
) -> float | None:
    """Return half way between the fold and the stable motion behind it [m]."""
    behind = fold.frequency * (1.0 + (BEYOND if upward else -BEYOND))
    frequency, seen = traced.curve.frequency, traced.curve.amplitude[:, 0]
    here = float(np.hypot(*fold.seen(problem.probes.rows[:1])[1:3, 0]))
    landings = []
    for first in range(len(frequency) - 1):
        low, high = frequency[first : first + 2]
        stable = traced.curve.unstable[first : first + 2].max() <= 0
        if stable and (low - behind) * (high - behind) <= 0.0 and low != high:
            share = (behind - low) / (high - low)
            landings.append(seen[first] + share * (seen[first + 1] - seen[first]))
    if not landings:
        return None
    landing = min(landings, key=lambda each: abs(each - here))
    return 0.5 * (here + float(landing))


def _swept(
    problem: Problem, fold: Fold, rate: float, steps: int
) -> tuple[Array, Array]:
    """Return the envelope of a sweep through a fold, by frequency [Hz]."""
    begin = fold.begin.frequency / (2.0 * np.pi)
    duration = abs(fold.end - begin) / rate
    sweep = SweptSine(0.0, 0.0, duration, duration, begin, fold.end)
    stride = max(1, steps // ROWS)
    options = MarchOptions(1.0 / (stride * ROWS * fold.hertz), stride)
    start = on_orbit(problem, fold.begin)
    blocks = list(integrate(problem, sweep, options, start=start, block=duration))
    history = joined(blocks, "complete")
    hertz, envelope = envelope_of(history, sweep.frequency(history.time), 0.0, duration)
    return hertz, envelope[:, 0]


def _passed(fold: Fold, hertz: Array, envelope: Array) -> float:
    """Return the frequency at which an envelope passes the height for good [Hz]."""
    side = np.sign(envelope - fold.height)
    (before,) = np.nonzero(side == side[:1])
    last = int(before.max(initial=0))
    if last >= len(hertz) - 1:
        raise StudyError(
            f"no jump within {abs(fold.end - fold.hertz):.3g} Hz behind the fold at "
            f"{fold.hertz:.6g} Hz: give slower sweeps, or a longer lead"
        )
    ends = envelope[last : last + 2]
    share = (fold.height - ends[0]) / (ends[1] - ends[0])
    return float(hertz[last] + share * (hertz[last + 1] - hertz[last]))
