"""Does a periodic response stay what it is when time runs? (theory §7.3)."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import on_orbit

ROWS_PER_PERIOD = 60


@dataclass(frozen=True, slots=True)
class Agreement:
    """How far a march leaves the periodic response on which it began."""

    frequency: float
    """excitation frequency [rad/s]"""
    predicted: Array
    """first-harmonic amplitude of the periodic response [m], shape (probes,)"""
    marched: Array
    """first-harmonic amplitude of the last period of the march [m], shape (probes,)"""
    first_distance: float
    """largest distance of the first period from the orbit, over the orbit's size"""
    last_distance: float
    """the same for the last period"""
    drift: float
    """change of the amplitude over the last tenth of the march, relative"""
    closing_error: float
    """of the energy balance, over the input energy"""
    unstable: int
    """Floquet multipliers of the response outside the unit circle; −1 if not known"""

    @property
    def deviation(self) -> Array:
        """Relative difference of the amplitude of each probe, shape (probes,).

        A probe that moves by less than a hundredth of the largest amplitude is measured
        by that hundredth: how far nothing differs from nothing says nothing.
        """
        size = np.maximum(self.predicted, 0.01 * self.predicted.max())
        deviation: Array = np.abs(self.marched - self.predicted) / size
        return deviation


def march_periods(
    problem: Problem,
    response: PeriodicResponse,
    *,
    periods: int,
    steps_per_period: int,
) -> Iterator[TimeHistory]:
    """Yield the march that begins on a periodic response, ten periods at a time.

    ``steps_per_period`` is rounded up to a multiple of the stored rows per period.
    """
    period = 2.0 * np.pi / response.frequency
    stride = -(-steps_per_period // ROWS_PER_PERIOD)
    yield from integrate(
        problem,
        Dwell(response.frequency, periods * period),
        MarchOptions(period / (stride * ROWS_PER_PERIOD), store_every=stride),
        start=on_orbit(problem, response),
        block=10.0 * period,
    )


def agreement(
    problem: Problem, response: PeriodicResponse, blocks: list[TimeHistory]
) -> Agreement:
    """Compare a march from :func:`march_periods` with the response it began on.

    Distances are taken over all probes and all phases of a period; the orbit's size is
    its largest first-harmonic amplitude.
    """
    history = joined(blocks, "complete")
    phase = 2.0 * np.pi * np.arange(1, ROWS_PER_PERIOD + 1) / ROWS_PER_PERIOD
    orbit = response.at(phase)[0] @ problem.probes.rows.T
    cycles = history.displacement.reshape(-1, ROWS_PER_PERIOD, orbit.shape[1])
    rotation = np.exp(-1j * phase)[:, None] * 2.0 / ROWS_PER_PERIOD
    predicted = np.abs((rotation * orbit).sum(axis=0))
    amplitudes = np.abs((rotation * cycles).sum(axis=1))
    size = predicted.max()
    away = np.abs(cycles - orbit).max(axis=(1, 2)) / size
    tail = min(max(1, len(amplitudes) // 10), len(amplitudes) - 1)
    drift = np.abs(amplitudes[-1] - amplitudes[-1 - tail]).max() / size
    closing = np.abs(history.closing_error).max() / np.abs(history.of("input")).max()
    return Agreement(
        response.frequency,
        predicted,
        amplitudes[-1],
        float(away[0]),
        float(away[-1]),
        float(drift),
        float(closing),
        response.unstable,
    )
