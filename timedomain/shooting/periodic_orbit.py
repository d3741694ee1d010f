"""A periodic motion found in time, and how far it may be wrong (theory §7.3)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import TINY, Array, ComplexArray
from timedomain.record.start import Start
from timedomain.shooting.closed_march import ClosedMarch
from timedomain.shooting.floquet import Multipliers, extrapolated_multipliers
from timedomain.shooting.period_sensitivity import loose_monodromy
from timedomain.shooting.small_motions import small_motions

SHARE = 8
"""steps of the coarser march in a cycle of the highest harmonic"""


@dataclass(frozen=True, slots=True)
class PeriodicOrbit:
    """A periodic motion under drive · sin ωt."""

    start: Start
    """of the finer march, at phase 0: marched with its steps, it repeats itself"""
    coefficients: Array
    """a₀, a₁, b₁, … [m or rad], extrapolated in the steps, (2 harmonics + 1, dofs)"""
    moved: Array
    """how far extrapolation moved them, signed, of the same shape"""
    rows: Array
    """of the probes that :attr:`error` speaks of, shape (probes, dofs)"""
    multipliers: ComplexArray
    """Floquet multipliers, extrapolated, the largest first, shape (2 dofs + sliders,)

    A slider that never slips has one of exactly 1, since its position is free: these
    are left out.
    """
    multiplier_error: Array
    """how far they are from those of the coarser steps, of the same shape"""
    stuck: NDArray[np.bool_]
    """points that remember and never slip, shape (points,)"""
    friction_energy: float
    """taken out by friction per period, extrapolated [J]"""
    neutral: int
    """directions in which nothing pins the mean position: it is that of the start"""
    steps: int
    """of the finer march"""
    error: float
    """estimated, of the amplitudes over the largest one (:func:`amplitude_error`)"""

    @property
    def amplitude(self) -> Array:
        """First harmonic of each probe [m], shape (probes,)."""
        return _amplitude(self.coefficients, self.rows)


def extrapolated(
    coarse: ClosedMarch,
    fine: ClosedMarch,
    error: float,
    halved: ClosedMarch | None = None,
) -> PeriodicOrbit:
    """Return the orbit to which two marches converge, the second of twice the steps.

    The error of a step falls with its square: extrapolation adds a third of the change.
    ``error`` is that of the amplitudes; ``halved``, a march of half the first's steps,
    tells multipliers' errors that are small by chance.
    """
    coefficients, moved = _coefficients_of(coarse, fine)
    stuck = coarse.period.slides.stuck | fine.period.slides.stuck
    multipliers = _multipliers(coarse, fine, stuck)
    if halved is not None:
        multipliers = multipliers.after(_multipliers(halved, coarse, stuck))
    more = (fine.period.friction - coarse.period.friction) / 3.0
    return PeriodicOrbit(
        fine.map.start(fine.state),
        coefficients,
        moved,
        fine.map.problem.probes.rows,
        multipliers.values,
        multipliers.error,
        _points(fine, stuck),
        fine.period.friction + more,
        max(coarse.neutral, fine.neutral),
        fine.map.steps,
        error,
    )


def amplitude_error(coarse: ClosedMarch, fine: ClosedMarch) -> float:
    """Return the estimated error of extrapolated amplitudes, over the largest one.

    How far they are from those of half the steps, three times as much as extrapolation
    moves them: it gains nothing where friction turns over within a step. To that comes
    three times what is left where a march leaps.
    """
    rows, (coefficients, moved) = (
        fine.map.problem.probes.rows,
        _coefficients_of(coarse, fine),
    )
    amplitude = _amplitude(coefficients, rows)
    away = np.abs(amplitude - _amplitude(coefficients - moved, rows)).max(initial=0.0)
    steps = float(away / max(amplitude.max(initial=0.0), TINY))
    return 3.0 * (steps + max(coarse.left, fine.left))


def first_harmonic(marched: ClosedMarch) -> Array:
    """Return a₁ and b₁ of the displacement [m or rad], shape (2, dofs)."""
    return _coefficients(marched, 1)[1:]


def _multipliers(
    coarse: ClosedMarch, fine: ClosedMarch, stuck: NDArray[np.bool_]
) -> Multipliers:
    """Return the multipliers to which two marches converge."""
    return extrapolated_multipliers(
        *(_small_motions(each, stuck) for each in (coarse, fine))
    )


def _small_motions(marched: ClosedMarch, stuck: NDArray[np.bool_]) -> Array:
    """Return what becomes of a small motion in a period, (states, states)."""
    found = small_motions(marched.map, marched.period)
    if found is None:
        found = marched.monodromy()
    return loose_monodromy(marched.map, found, stuck)


def _coefficients_of(coarse: ClosedMarch, fine: ClosedMarch) -> tuple[Array, Array]:
    """Return the extrapolated coefficients, and how far they were moved."""
    harmonics = coarse.map.steps // SHARE
    before, after = (_coefficients(each, harmonics) for each in (coarse, fine))
    moved = (after - before) / 3.0
    return after + moved, moved


def _points(marched: ClosedMarch, stuck: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which points have sliders that are stuck, shape (points,)."""
    sliders = marched.map.sliders
    found = np.zeros(sliders.points.load.size, dtype=bool)
    found[sliders.point[stuck]] = True
    return found


def _coefficients(marched: ClosedMarch, harmonics: int) -> Array:
    """Return a₀, a₁, b₁, … of the displacement, shape (2 harmonics + 1, dofs)."""
    steps = marched.map.steps
    spectrum = np.fft.rfft(marched.period.displacement[:-1], axis=0)[: harmonics + 1]
    found = np.empty((2 * harmonics + 1, spectrum.shape[1]))
    found[0] = spectrum[0].real / steps
    found[1::2] = 2.0 / steps * spectrum[1:].real
    found[2::2] = -2.0 / steps * spectrum[1:].imag
    return found


def _amplitude(coefficients: Array, rows: Array) -> Array:
    """Return the first harmonic of each probe, shape (probes,)."""
    found: Array = np.hypot(*(coefficients[1:3] @ rows.T))
    return found
