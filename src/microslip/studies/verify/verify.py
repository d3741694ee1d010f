"""Do both solvers agree? Orbits that must stay, and sweeps that slow to the curve."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from microslip.progress import Watch
from microslip.scenes.scene import Scene
from microslip.studies.sweep import march_whole, swept_sine
from microslip.studies.verify.quasi_static import (
    compared_energies,
    followed_by,
    quasi_static_energy,
)
from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.results.response_curve import ResponseCurve
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.verify import Agreement, agreement, march_periods


class StudyError(MicroslipError):
    """Solvers that cannot be compared as asked."""


@dataclass(frozen=True, slots=True)
class SweepAgreement:
    """A swept sine beside what the curve predicts for an infinitely slow one."""

    slower: float
    """how many times longer than the scene's sweep"""
    energy: float
    """dissipated by friction while the drive acts, over ``slower`` [J]"""
    quasi_static: float
    """the curve's prediction of the same [J]"""
    envelope_error: float
    """mean difference of the cycles' peaks and the curve's, over their mean"""
    closing_error: float
    """of the energy balance, over the input"""
    envelope_frequency: Array
    """excitation frequency of each cycle [Hz]"""
    envelope: Array
    """largest deflection of each cycle [m], shape (cycles, probes)"""
    estimated: float = float("nan")
    """error of ``energy`` by the march's time steps [J]; NaN if it estimates none"""
    chosen: tuple[float, ...] = ()
    """frequencies [Hz] beyond which the prediction takes the sweep's branch of many"""

    @property
    def rubs(self) -> bool:
        """Whether friction takes out energy that is compared."""
        return self.quasi_static != 0.0

    @property
    def energy_error(self) -> float:
        """Relative difference of the energies."""
        return self.energy / self.quasi_static - 1.0 if self.rubs else 0.0


def orbits(
    problem: Problem,
    responses: list[PeriodicResponse],
    *,
    periods: int,
    steps_per_period: int,
) -> Iterator[Agreement]:
    """Yield the agreement of each response with the march that begins on it."""
    for response in responses:
        blocks = list(
            march_periods(
                problem, response, periods=periods, steps_per_period=steps_per_period
            )
        )
        yield agreement(problem, response, blocks)


def sweep_agreement(
    scene: Scene,
    problem: Problem,
    curve: ResponseCurve,
    *,
    slower: float,
    watch: Watch = iter,
) -> SweepAgreement:
    """March the scene's sweep, ``slower`` times as long; compare it with a curve."""
    sweep = swept_sine(scene.sweep, slower=slower)
    history = march_whole(problem, sweep, scene.march, watch)
    frequency, envelope = envelope_of(
        history, sweep.frequency(history.time), sweep.start, sweep.end
    )
    places, chosen = followed_by(curve, frequency, envelope)
    hertz = curve.frequency[places] / (2.0 * np.pi)
    predicted = np.stack(
        [np.interp(frequency, hertz, peak) for peak in curve.peak[places].T], axis=1
    )
    span = scene.sweep.lowest, scene.sweep.highest
    slow = quasi_static_energy(curve, sweep.rate * slower, span, places)
    return SweepAgreement(
        slower,
        *compared_energies(history, (sweep.start, sweep.end), slow, slower),
        float(np.abs(envelope - predicted).mean() / predicted.mean()),
        float(np.abs(history.closing_error).max() / history.of("input").max()),
        frequency,
        envelope,
        _estimated(history, sweep.end) / slower,
        tuple(chosen),
    )


def _estimated(history: TimeHistory, time: float) -> float:
    """Return the estimated error of friction's energy so far [J]; NaN without one."""
    if not history.energy_error.size:
        return float("nan")
    return float(np.interp(time, history.time, history.energy_error))


def falls(agreements: list[SweepAgreement]) -> bool:
    """Return whether the slowest sweep comes closer to the curve than the others.

    Its envelope is closest of all, its energy closer than that of the fastest. That one
    may lie where the energy's difference passes zero: then it is enough if the energy
    is closer than that of another one, and than the envelope.
    """
    if len(agreements) < 2:
        return True
    *others, slowest = sorted(agreements, key=lambda each: each.slower)
    envelopes = [each.envelope_error for each in others]
    energies = [abs(each.energy_error) for each in others]
    left = abs(slowest.energy_error)
    by_chance = left < min(max(energies), slowest.envelope_error)
    closer = left == 0.0 or left < energies[0] or by_chance
    return closer and slowest.envelope_error < min(envelopes)


def rate_of(agreements: list[SweepAgreement]) -> float | None:
    """Return the exponent by which the energies' difference falls with duration.

    None where there are less than two sweeps, or where no power of the duration
    describes them: the difference vanishes, changes its sign, or falls and grows.
    """
    order = sorted(agreements, key=lambda each: each.slower)
    error = np.array([each.energy_error for each in order])
    known = bool(error.all() and np.isfinite(error).all())
    if len(order) < 2 or not known or np.unique(np.sign(error)).size > 1:
        return None
    size = np.log(np.abs(error))
    if np.unique(np.sign(np.diff(size))).size > 1:
        return None
    return float(-np.polyfit(np.log([each.slower for each in order]), size, 1)[0])


def envelope_of(
    history: TimeHistory, frequency: Array, start: float, end: float
) -> tuple[Array, Array]:
    """Return frequency and largest deflection of each cycle of the drive.

    ``frequency`` is that of the drive [Hz] at each stored time; ``start`` and ``end``
    are the times [s] between which it acts.

    Raises
    ------
    StudyError
        If a cycle has less than four stored times.
    """
    driven = (history.time >= start) & (history.time <= end)
    hertz = frequency[driven]
    shown = history.displacement[driven]
    spacing = np.diff(history.time).max(initial=0.0)
    if len(history.time) < 2 or spacing * hertz.max(initial=0.0) > 0.25:
        raise StudyError(
            "the sweep is stored too rarely to see its cycles: give a smaller "
            "march.store_every"
        )
    cycle = np.floor(np.cumsum(hertz) * spacing).astype(int)
    edges = np.flatnonzero(np.diff(cycle, prepend=cycle[0] - 1))
    high = np.maximum.reduceat(shown, edges, axis=0)
    low = np.minimum.reduceat(shown, edges, axis=0)
    # the last cycle is cut off
    return hertz[edges[:-1]], (high - low)[:-1] / 2.0
