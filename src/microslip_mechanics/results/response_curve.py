"""A curve of periodic responses, along frequency or a parameter."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.by_value import ByValue
from microslip_mechanics.problem import Problem
from microslip_mechanics.quantity import apart
from microslip_mechanics.results.response import PeriodicResponse, measure

PULL = 0.1
"""of its largest push: a pull from which what pulls is no contact"""
PEAK_SAMPLES = 1024
"""of a period, to find the largest value in time"""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class ResponseCurve(ByValue):
    """A frequency response curve in the order in which it was traced."""

    frequency: Array
    """excitation frequency ω [rad/s], shape (points,)"""
    probes: tuple[str, ...]
    amplitude: Array
    """first harmonic of each probe [m], shape (points, probes)"""
    amplitude_lowest: Array
    """the least that was found with other residual tractions of contacts that stick
    [m], shape (points, probes); the amplitude itself where these change nothing"""
    amplitude_highest: Array
    """the greatest [m], shape (points, probes)"""
    peak: Array
    """half of the way from least to largest in time [m], shape (points, probes)"""
    velocity_peak: Array
    """largest velocity in time [m/s], shape (points, probes)"""
    contacts: tuple[str, ...]
    normal_smallest: Array
    """[N], shape (points, contacts)"""
    normal_largest: Array
    """[N], shape (points, contacts)"""
    friction_energy: Array
    """per period [J], shape (points,)"""
    damping_energy: Array
    """of normal contact damping, per period [J], shape (points,)"""
    friction_energy_error: Array
    """estimated one of that [J]; NaN if none was asked for, shape (points,)"""
    damping_energy_error: Array
    """estimated one of that [J], shape (points,)"""
    normal_error: Array
    """estimated one of smallest and largest normal forces [N], (points, contacts)"""
    residual: Array
    """largest unbalanced force [N], shape (points,)"""
    outcome: tuple[str, ...]
    """how each point's correction ended"""
    iterations: Array
    """Newton iterations, shape (points,)"""
    harmonics: Array
    """that were solved for, shape (points,)"""
    samples: Array
    """of the contacts per period, shape (points,)"""
    error: Array
    """estimated relative error of the amplitude, shape (points,)"""
    multiplier: Array
    """largest modulus of a Floquet multiplier; 0 if not known, shape (points,)"""
    unstable: Array
    """number of multipliers outside the unit circle; −1 if not known, (points,)"""
    event: tuple[str, ...]
    """what each point is located as: peak, fold, …; empty for points of the trace"""
    parameter: Array
    """what the curve is followed along, in SI units; ω itself along frequency"""
    parameter_error: Array
    """estimated one of where a peak or a fold lies; NaN for other points, (points,)"""
    along: str
    """name of that parameter; empty along frequency"""
    ending: str
    """how the curve ended: "complete", "interrupted", or the cause"""

    @property
    def contact_energy(self) -> Array:
        """What contacts take out per period, by friction and damping [J], (points,)."""
        total: Array = self.friction_energy + self.damping_energy
        return total

    @property
    def pulls(self) -> bool:
        """Whether springs or dampers are among the contacts, which hardly pull."""
        return pulling(self.normal_smallest, self.normal_largest)

    def __repr__(self) -> str:
        """Return what kind of curve it is, in a line.

        It may turn back, or begin anew: it spans as far as it comes from its beginning.
        """
        values = self.parameter if self.along else self.frequency / (2.0 * np.pi)
        name = self.along or "Hz"
        away = np.abs(values - values[:1])
        ends = apart(values[0], values[away.argmax()]) if values.size else ()
        span = f", {' to '.join(ends)} {name}" if ends else ""
        counts = Counter(event for event in self.event if event)
        events = "".join(f"; {event}: {number}" for event, number in counts.items())
        return (
            f"<ResponseCurve: {values.size} points{span}{events}; "
            f"probes {', '.join(self.probes)}; {self.ending}>"
        )


def pulling(smallest: Array, largest: Array) -> bool:
    """Return whether some of these forces [N] are of springs or dampers.

    ``smallest`` and ``largest`` have one column for each contact, or are of one row.
    """
    least = np.fmin.reduce(np.atleast_2d(smallest), axis=0, initial=0.0)
    most = np.fmax.reduce(np.atleast_2d(largest), axis=0, initial=0.0)
    return bool((least < -PULL * most).any())


def response_curve(
    problem: Problem,
    points: Sequence[PeriodicResponse],
    ending: str,
    along: str = "",
) -> ResponseCurve:
    """Gather periodic responses to a curve along frequency, or along a parameter."""
    probes = (len(problem.probes.names),)
    contacts = (problem.interface.count,)
    seen = [_seen(point, problem.probes.rows) for point in points]
    amplitude, peak, velocity_peak = (
        np.array(column).reshape(len(points), *probes)
        for column in (zip(*seen, strict=True) if seen else ((), (), ()))
    )

    def column(name: str, shape: tuple[int, ...] = ()) -> Array:
        values = [getattr(point, name) for point in points]
        return np.array(values, dtype=float).reshape(len(points), *shape)

    return ResponseCurve(
        column("frequency"),
        problem.probes.names,
        amplitude,
        *_range(points, amplitude),
        peak,
        velocity_peak,
        problem.interface.names,
        column("normal_smallest", contacts),
        column("normal_largest", contacts),
        column("friction_energy"),
        column("damping_energy"),
        column("friction_error"),
        column("damping_error"),
        np.array([_told(point) for point in points]).reshape(len(points), *contacts),
        column("residual"),
        tuple(point.outcome for point in points),
        column("iterations"),
        column("harmonics"),
        column("samples"),
        column("error"),
        np.array([np.abs(p.multipliers).max(initial=0.0) for p in points]),
        column("unstable"),
        tuple(point.event for point in points),
        column("parameter"),
        column("parameter_error"),
        along,
        ending,
    )


def _told(point: PeriodicResponse) -> Array:
    """Return the errors of normal forces [N], NaN where none was asked for."""
    nobody = np.full_like(point.normal_largest, np.nan)
    return point.normal_error if point.normal_error.size else nobody


def _range(points: Sequence[PeriodicResponse], amplitude: Array) -> tuple[Array, Array]:
    """Return the lowest and the highest amplitudes [m], each (points, probes)."""
    low, high = amplitude.copy(), amplitude.copy()
    for place, point in enumerate(points):
        if point.residual_range.size:
            less, more = point.residual_range * measure(amplitude[place])
            low[place] += less
            high[place] += more
    return low, high


def _seen(point: PeriodicResponse, rows: Array) -> tuple[Array, Array, Array]:
    """Return amplitude, half of the swing and largest velocity, (probes,) each."""
    seen = point.seen(rows)
    orders = np.arange(seen.shape[0] // 2 + 1)[:, None]
    samples = max(PEAK_SAMPLES, 8 * len(seen))
    amplitudes = np.zeros((samples // 2 + 1, seen.shape[1]), complex)
    amplitudes[1 : len(orders)] = (seen[1::2] - 1j * seen[2::2]) * samples / 2.0
    rates = amplitudes.copy()
    rates[: len(orders)] *= 1j * point.frequency * orders
    displacement, velocity = (
        np.fft.irfft(each, samples, axis=0) for each in (amplitudes, rates)
    )
    return (
        np.hypot(seen[1], seen[2]),
        0.5 * np.ptp(displacement, axis=0),
        np.abs(velocity).max(axis=0),
    )
