"""One nonlinear mode at any number of harmonics and samples (theory §6.8)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hbm.balance.active import extended
from hbm.balance.relative import RelativeProblem
from hbm.forces.fourier import FourierBasis
from hbm.forces.marched import marched
from hbm.modes.free_motion import FreeMotion
from hbm.modes.linear_modes import LinearMode
from hbm.modes.modal import ModalBalance
from hbm.modes.modal_parts import ModalParts, Reference
from hbm.modes.modal_unknowns import ModalUnknowns
from hbm.resolution.estimate import Estimate
from hbm.resolution.resolution import Resolution
from microslip_mechanics.arrays import Array

DAMPING, FREQUENCY = 0, 2
"""which of the values of a mode they are"""
FAINTEST = 1e-4
"""damping ratio below which errors of damping are relative to this one"""
STRICTER = 100.0
"""times an error of the frequency counts: frequencies are known better than damping,
and hardly change where that changes by orders of magnitude"""


class ModalResolution(Resolution):
    """Balances of a mode; what is estimated are errors of damping and frequency."""

    def __init__(
        self,
        problem: RelativeProblem,
        active: NDArray[np.bool_],
        free: FreeMotion,
        reference: Reference,
        linear: LinearMode,
    ) -> None:
        """Resolve ``problem`` in ``active`` coefficients of the probing orders."""
        self._problem, self._active = problem, active
        self._free, self._reference, self._linear = free, reference, linear
        self._balances: dict[FourierBasis, ModalBalance] = {}
        self.rank = problem.rank + free.count + 1
        self.marched = bool(marched(problem.points).any())

    def at(self, fourier: FourierBasis) -> ModalBalance:
        """Return the balance at one resolution."""
        if fourier not in self._balances:
            self._balances[fourier] = ModalBalance(
                self._problem,
                self._free,
                self._reference,
                fourier,
                extended(self._active, fourier.harmonics),
            )
        return self._balances[fourier]

    def amplitudes(self, points: Sequence[Array]) -> Array:
        """Return the values by whose change errors of a mode are measured, (points, 3).

        They are the decay rate over that of the first point, or over the least that
        counts; one, which the others are compared with; and :data:`STRICTER` times the
        relative change of the frequency since the first point.
        """
        poles = np.array([self._unknowns.parts(point).pole for point in points])
        least = max(abs(poles[0].real), FAINTEST * abs(poles[0]))
        ones = np.ones(len(points))
        turned = STRICTER * (np.abs(poles) / abs(poles[0]) - 1.0)
        return np.array([-poles.real / least, ones, turned]).T

    def steepness(self, estimate: Estimate) -> float:
        """Return the error of the damping: that of the frequency counts too much."""
        return estimate.of(DAMPING)[1]

    def errors(self, estimate: Estimate, corrected: bool) -> tuple[float, float]:
        """Return those of frequency and damping ratio, relative.

        They are of the point after the steps of the estimate if it is ``corrected``.
        """
        damping, frequency = (
            error if corrected else change + error
            for change, error in map(estimate.of, (DAMPING, FREQUENCY))
        )
        return frequency / STRICTER, damping

    def metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc."""
        return self._unknowns.metric(point)

    def start(self, logarithm: float, size: int) -> Array:
        """Return the point of the linear mode at log a, with ``size`` components."""
        pole, motion = self._linear.pole, self._linear.shape
        relative = self._problem.selection @ motion
        shape = np.zeros((3, relative.size))
        shape[1], shape[2] = relative.real, -relative.imag
        modal = self._free.modal(pole, relative, motion)
        parts = ModalParts(shape, modal, pole, math.exp(logarithm))
        return self._unknowns.point(parts, size)

    @property
    def _unknowns(self) -> ModalUnknowns:
        """Those up to order 1."""
        return self.at(FourierBasis(1, 8)).unknowns
