"""Where a swept sine jumps, extrapolated to an infinitely slow sweep.

A sweep that passes a fold at the rate r jumps late by a delay that goes like r^(2/3):
near a saddle-node x' = r t + x² escapes where the first zero of Airy's function lies
(Haberman, SIAM J. Appl. Math. 37, 1979; Jung, Gray, Roy & Mandel, Phys. Rev. Lett. 65,
1990). The time that the motion then takes to fall adds a term like r.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from microslip.interruption import unmasked
from microslip.studies.jump_folds import Fold
from microslip.studies.march_size import demand_end
from microslip.studies.verify import StudyError, envelope_of
from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.time_history import joined
from timedomain.integrate import MarchOptions, integrate
from timedomain.start import on_orbit
from timedomain.step_doubling import CAUTION

LEAST = 4
"""rates: three unknowns of the fit, and one to judge it by"""
RATES = (2.2e-5, 1.1e-5, 5.5e-6, 2.75e-6)
"""of the sweeps, over the square of a fold's frequency, unless others are asked for"""
STEPS, ROWS = 200, 20
"""taken and stored per period; another march takes half as many steps"""
BLOCK = 200
"""periods after which one looks whether the motion has jumped"""

Envelope: TypeAlias = tuple[Array, Array]
"""frequency [Hz] and largest deflection [m] of each cycle"""
Sweep: TypeAlias = tuple[float, float, Envelope]
"""where it jumps, and where with steps twice as long [Hz]; its envelope"""


@dataclass(frozen=True, slots=True)
class Jump:
    """Where sweeps of several rates jump, and what follows for a slow one."""

    fold: Fold
    rates: Array
    """[Hz/s], shape (rates,)"""
    frequency: Array
    """at which the envelope has fallen or risen half way [Hz], shape (rates,)"""
    extrapolated: float
    """to no rate [Hz]; NaN while there are too few rates"""
    fit_error: float
    """of that, see :func:`extrapolated` [Hz]"""
    step_error: float
    """of that, by the length of time steps [Hz]"""
    envelopes: tuple[Envelope, ...]
    """for each rate"""

    @property
    def error(self) -> float:
        """Of ``extrapolated``, by both [Hz]."""
        return self.fit_error + self.step_error

    @property
    def whole(self) -> bool:
        """Whether enough sweeps were made to extrapolate."""
        return not math.isnan(self.extrapolated)


def jumps(
    problem: Problem,
    folds: Sequence[Fold],
    rates: Sequence[float] | None = None,
    *,
    steps: int = STEPS,
) -> Iterator[Jump]:
    """Yield the jump at each fold; of one that is not swept to its end what there is.

    Parameters
    ----------
    problem
        What is marched, with ``steps`` per period, rounded down to double steps of
        whole rows, and beside with half as many.
    folds
        Of its curve.
    rates
        Of the sweeps [Hz/s], at least :data:`LEAST` different ones; :data:`RATES` of
        each fold if left out.

    Raises
    ------
    StudyError
        If a sweep does not jump before its end: after what there is of its fold.
    KeyboardInterrupt
        After what there is of the fold whose sweeps are interrupted.
    """
    if rates is not None and len(set(rates)) < LEAST:
        raise StudyError(f"{len(set(rates))} rates: give at least {LEAST} different")
    for fold in folds:
        chosen = [fold.hertz**2 * each for each in RATES] if rates is None else rates
        ordered = np.array(sorted(set(chosen), reverse=True))
        swept: list[Sweep] = []
        try:
            with unmasked():
                for rate in ordered:
                    swept.append(_swept(problem, fold, rate, steps))  # noqa: PERF401  (what is there must be kept)
        except (KeyboardInterrupt, MicroslipError):
            if swept:
                yield _jump(fold, ordered[: len(swept)], swept)
            raise
        yield _jump(fold, ordered, swept)


def _jump(fold: Fold, rates: Array, swept: Sequence[Sweep]) -> Jump:
    """Return what sweeps of these rates tell; too few tell of none slower."""
    places = np.array([place for place, _, _ in swept])
    others = np.array([other for _, other, _ in swept])
    envelopes = tuple(envelope for _, _, envelope in swept)
    slow = (math.nan, math.nan, math.nan)
    if len(rates) >= LEAST:
        found, error = extrapolated(rates, places)
        other, _ = extrapolated(rates, others)
        slow = (found, error, CAUTION * abs(found - other))
    return Jump(fold, rates, places, *slow, envelopes)


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


def _swept(problem: Problem, fold: Fold, rate: float, steps: int) -> Sweep:
    """Sweep through a fold with these steps per period, and with half as many."""
    half = ROWS * max(1, steps // (2 * ROWS))
    place, envelope = _marched(problem, fold, rate, 2 * half)
    other, _ = _marched(problem, fold, rate, half)
    return place, other, envelope


def _marched(
    problem: Problem, fold: Fold, rate: float, steps: int
) -> tuple[float, Envelope]:
    """March through a fold until the motion has jumped.

    Return where [Hz], and the envelope.

    Raises
    ------
    StudyError
        If it does not jump before the sweep's end.
    SceneError
        If the sweep would not end.
    """
    begin = fold.begin.frequency / (2.0 * np.pi)
    duration = abs(fold.end - begin) / rate
    sweep = SweptSine(0.0, 0.0, duration, duration, begin, fold.end)
    options = MarchOptions(1.0 / (steps * fold.hertz), steps // ROWS)
    demand_end(sweep, options, "give faster --rates")
    start = on_orbit(problem, fold.begin)
    blocks = []
    for block in integrate(
        problem, sweep, options, start=start, block=BLOCK / fold.hertz
    ):
        blocks.append(block)
        history = joined(blocks, "complete")
        driven = sweep.frequency(history.time)
        hertz, envelope = envelope_of(history, driven, 0.0, duration)
        place = _passed(fold, hertz, envelope[:, 0])
        if place is not None:
            return place, (hertz, envelope[:, 0])
    raise StudyError(
        f"no jump within {abs(fold.end - fold.hertz):.3g} Hz behind the fold at "
        f"{fold.hertz:.6g} Hz at {rate:.3g} Hz/s: give slower sweeps, or a longer lead"
    )


def _passed(fold: Fold, hertz: Array, envelope: Array) -> float | None:
    """Return the frequency at which an envelope leaves the fold's side of the height.

    That is where it first does so behind the fold or, if it is on the other side there
    already, where it last has before. None if it has not [Hz].
    """
    beyond = hertz > fold.hertz if fold.upward else hertz < fold.hertz
    stays = envelope > fold.height if fold.falls else envelope < fold.height
    (leaves,) = np.nonzero(stays[:-1] & ~stays[1:])
    (late,) = np.nonzero(beyond[leaves + 1])
    if leaves.size == 0 or not beyond[-1] or (late.size == 0 and stays[-1]):
        return None
    at = int(leaves[late[0] if late.size else -1])
    ends = envelope[at : at + 2]
    share = (fold.height - ends[0]) / (ends[1] - ends[0])
    return float(hertz[at] + share * (hertz[at + 1] - hertz[at]))
