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

import numpy as np

from microslip.interruption import unmasked
from microslip.studies.jumps.folds import Fold
from microslip.studies.jumps.sweeps import Envelope, Sweep, swept_through
from microslip.studies.verify.verify import StudyError
from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from timedomain.step_doubling import CAUTION

LEAST = 4
"""rates: three unknowns of the fit, and one to judge it by"""
RATES = (2.2e-5, 1.1e-5, 5.5e-6, 2.75e-6)
"""of the sweeps, over the square of a fold's frequency, unless others are asked for"""


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
) -> Iterator[Jump]:
    """Yield the jump at each fold; of one that is not swept to its end what there is.

    Parameters
    ----------
    problem
        What is marched.
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
                    swept.append(swept_through(problem, fold, rate))  # noqa: PERF401  (what is there must be kept)
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
