"""Whether shooting finds the orbit that harmonic balance found (theory §7.3)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import TINY, Array, largest
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import MARGIN, PeriodicResponse
from timedomain.record.start import on_orbit
from timedomain.shooting.closed_march import ShootingError
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit

FLOOR = 1e-5
"""relative difference of amplitudes that no estimate accounts for: stiff contacts in
perfect symmetry are reproducible no better"""
COVERAGE = 3.0
"""times its estimate by which harmonic balance may err at a single point: the estimate
bounds 95 points of a hundred, by the problems of ``tests/hbm/test_adaptive.py``"""
MULTIPLIER_FLOOR = 2e-3
"""the same of a multiplier's modulus, for which harmonic balance has no estimate"""


@dataclass(frozen=True, slots=True)
class Comparison:
    """A periodic response of harmonic balance beside the orbit found from it."""

    response: PeriodicResponse
    predicted: Array
    """first-harmonic amplitude by harmonic balance [m], shape (probes,)"""
    found: Array
    """by shooting [m], shape (probes,)"""
    predicted_error: float
    """estimated, over the largest amplitude; infinite if it is not known"""
    found_error: float
    """the same by shooting"""
    harmonics: Array
    """largest difference of the probes' coefficients over the largest amplitude, by
    order from 0, shape (orders,)"""
    multiplier: float
    """largest modulus by harmonic balance; 0 if not known"""
    found_multiplier: float
    """the same by shooting"""
    multiplier_error: float
    """of the largest multiplier by shooting"""
    steps: int
    """of the period, in the finer march"""

    @property
    def difference(self) -> float:
        """Largest difference of the probes' amplitudes, over the largest amplitude."""
        away = np.abs(self.found - self.predicted).max(initial=0.0)
        return float(away / max(self.found.max(initial=0.0), TINY))

    @property
    def estimated(self) -> float:
        """Difference that both estimates and the floor account for."""
        return self.predicted_error + self.found_error + FLOOR

    @property
    def admitted(self) -> float:
        """The same with :data:`COVERAGE`: no single point may differ by more."""
        return COVERAGE * self.predicted_error + self.found_error + FLOOR

    @property
    def as_estimated(self) -> bool:
        """Whether the amplitudes differ by no more than both estimates."""
        return self.difference <= self.estimated

    @property
    def agrees(self) -> bool:
        """Whether they differ by no more than is admitted.

        Without an estimate of harmonic balance anything does.
        """
        return self.difference <= self.admitted

    @property
    def as_stable(self) -> bool:
        """Whether both say the same of the stability, or cannot tell it from 1."""
        if self.multiplier == 0.0:
            return True
        outside = 1.0 + MARGIN
        if (self.multiplier > outside) == (self.found_multiplier > outside):
            return True
        apart = abs(self.multiplier - self.found_multiplier)
        return apart <= self.multiplier_error + MULTIPLIER_FLOOR

    @property
    def found_stable(self) -> bool | None:
        """Whether shooting calls the orbit stable; None where its error leaves that."""
        outside = self.found_multiplier - 1.0
        if abs(outside) <= self.multiplier_error + MARGIN:
            return None
        return outside < 0.0

    def worst(self) -> list[int]:
        """Return the three orders whose coefficients differ most, the worst first."""
        order = np.argsort(-self.harmonics, kind="stable")[:3]
        return [int(each) for each in order if self.harmonics[each] > 0.0]


def compared(
    problem: Problem,
    response: PeriodicResponse,
    options: ShootingOptions | None = None,
) -> Comparison:
    """Shoot from a response of harmonic balance; compare the two.

    Where they differ on stability, shorter steps are tried as long as there are some:
    what touches briefly leaves by how exactly that is carried.

    Raises
    ------
    ShootingError
        If there is no orbit near it.
    """
    chosen = options or ShootingOptions()
    made = _compared(problem, response, chosen)
    while not made.as_stable and 2 * made.steps <= chosen.most:
        try:
            made = _compared(problem, response, replace(chosen, steps=made.steps))
        except ShootingError:
            break
    return made


def _compared(
    problem: Problem, response: PeriodicResponse, options: ShootingOptions
) -> Comparison:
    """Compare a response with the orbit that shooting with some steps finds."""
    start = on_orbit(problem, response)
    orbit = periodic_orbit(
        problem, response.frequency, start=start, options=options, near=response
    )
    predicted = response.seen(problem.probes.rows)
    found = orbit.coefficients @ problem.probes.rows.T
    leading = int(np.abs(orbit.multipliers).argmax())
    return Comparison(
        response,
        np.hypot(predicted[1], predicted[2]),
        orbit.amplitude,
        response.error,
        orbit.error,
        _by_order(predicted, found),
        largest(response.multipliers),
        float(np.abs(orbit.multipliers[leading])),
        float(orbit.multiplier_error[leading]),
        orbit.steps,
    )


def _by_order(predicted: Array, found: Array) -> Array:
    """Return the largest difference of each order, over the largest amplitude."""
    away = found.copy()
    shared = min(len(predicted), len(found))
    away[:shared] -= predicted[:shared]
    size = max(float(np.hypot(found[1], found[2]).max(initial=0.0)), TINY)
    by_order = np.vstack([np.abs(away[:1]), np.hypot(away[1::2], away[2::2])])
    differences: Array = by_order.max(axis=1, initial=0.0) / size
    return differences
