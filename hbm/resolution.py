"""A system at any number of harmonics and samples, and the error of its points (§6)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np

from hbm.fourier import FourierBasis
from hbm.newton import CHORD, Correction, Linearised
from hbm.path import Path
from hbm.residual import Balance
from microslip_mechanics.arrays import Array, ComplexArray

SURE = 0.25
"""share of a residual that a Newton step leaves, after which the next leaves less"""
DEPARTS = 2.0
"""times that a residual grows in two steps that lead to no point"""
SMOOTHER = 1e-3
"""relative change of a threshold velocity that tells what it does"""
HALVED = 0.5
FEW, WARY, SAFE = 16, 9.0, 4.5
"""safety factors of impulses left out: with fewer harmonics than these, and with more"""
TURNING = 0.25
"""share of a phasor's change that counts where its length just has an extremum"""


@dataclass(frozen=True, slots=True)
class Estimate:
    """What two Newton steps at twice the resolution say of a point.

    They leave an error no larger than themselves where the series converges like 1/H,
    as dry friction does, and a much smaller one where it converges faster. Steps that
    raise the residual say nothing: the error is infinite.
    """

    truncation: float
    """relative change of the amplitude by the harmonics that were left out"""
    sampling: float
    """and by the distance of the samples"""
    smoothing: float
    """and by friction that is not resolved"""
    corrected: Array
    """the point after the steps"""
    fourier: FourierBasis
    """its resolution"""

    @property
    def error(self) -> float:
        """Sum of all."""
        return self.truncation + self.sampling + self.smoothing


class Refined(NamedTuple):
    """What two Newton steps at a finer resolution make of a point."""

    residual: Array
    """of the finer resolution at the point"""
    after: Array
    """the point after one step"""
    corrected: Array
    """and after both"""
    left: float
    """what further steps would change, over the second"""
    faster: float
    """what further harmonics would change, over those of the finer resolution"""


class Resolved(Protocol):
    """A system at one resolution."""

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        """Return the residual, and what solves with its Jacobian."""

    def residual(self, point: Array) -> tuple[Array, object]:
        """Return the residual, and what belongs to it."""

    def content(self, above: int, most: int) -> float:
        """Return the norm of the contact force between two orders in the last call."""


class Resolution(ABC):
    """A system at any number of harmonics and samples."""

    rank: int
    """number of components of a point for each Fourier coefficient"""

    @abstractmethod
    def at(self, fourier: FourierBasis) -> Resolved:
        """Return the system at one resolution."""

    @abstractmethod
    def amplitudes(self, point: Array) -> Array:
        """Return the values by whose change an error is measured."""

    def phasors(self, point: Array) -> ComplexArray:
        """Return what these are the moduli of."""
        return self.amplitudes(point).astype(complex)

    def estimate(
        self, correction: Correction, fourier: FourierBasis, normal: Array
    ) -> Estimate:
        """Return the error of a converged point, by two steps at twice the order.

        Both have the same factors. The corrected point lies in the plane through the
        point that is normal to ``normal``.

        Raises
        ------
        SingularError
            If the point lies on a fold.
        """
        point = correction.point
        finer = fourier.doubled
        refined = self._refined(point, finer, normal)
        low = refined.residual.copy()
        low[fourier.coefficients * self.rank :] = 0.0
        rights = np.zeros((point.size, 2))
        rights[:-1, 0] = -correction.residual
        rights[:-1, 1] = correction.residual - low
        newton, sampled = correction.linearised.solve(normal, rights).T
        before, at_newton, at_sampled, after, last = (
            self.amplitudes(each)
            for each in (
                point, point + newton, point + newton + sampled, refined.after,
                refined.corrected,
            )
        )  # fmt: skip
        size = float(before.max(initial=0.0)) or 1.0
        sampling = float(np.abs(at_sampled - at_newton).max(initial=0.0)) / size
        sampling *= HALVED
        truncation = float(np.abs(last - at_sampled).max(initial=0.0)) / size
        truncation *= refined.faster
        truncation += refined.left * float(np.abs(last - after).max(initial=0.0)) / size
        smoothing = 0.0
        if fourier.threshold > 0.0:
            change = self._resolved(correction, fourier, normal)
            sharp, smooth = self.phasors(point + change), self.phasors(point)
            turned = float(np.abs(sharp - smooth).max(initial=0.0))
            moved = float(np.abs(np.abs(sharp) - np.abs(smooth)).max(initial=0.0))
            smoothing = max(moved, TURNING * turned) / size
        return Estimate(truncation, sampling, smoothing, refined.corrected, finer)

    def _refined(self, point: Array, finer: FourierBasis, normal: Array) -> Refined:
        """Return what two steps at a finer resolution make of a point.

        The second has factors of its own if the first leaves much.
        """
        system = self.at(finer)
        residual, first = system(point)
        orders = finer.harmonics // 2, finer.harmonics, 2 * finer.harmonics + 1
        known = system.content(*orders[:2])
        after = point + first.solve(normal, np.append(-residual, 0.0))
        again, second = system(after)
        sizes = [float(np.linalg.norm(residual)), float(np.linalg.norm(again))]
        factors = first if sizes[1] <= CHORD * sizes[0] else second
        corrected = after + factors.solve(normal, np.append(-again, 0.0))
        sizes.append(float(np.linalg.norm(system.residual(corrected)[0])))
        beyond = system.content(*orders[1:])
        rest = _beyond(beyond / known, finer.harmonics) if known > 0.0 else 1.0
        return Refined(residual, after, corrected, _left(*sizes), rest)

    def _resolved(
        self, correction: Correction, fourier: FourierBasis, normal: Array
    ) -> Array:
        """Return how a point changes, to first order, if friction is resolved."""
        smoother = replace(fourier, threshold=(1.0 + SMOOTHER) * fourier.threshold)
        other, _ = self.at(smoother).residual(correction.point)
        slope = (other - correction.residual) / SMOOTHER
        return correction.linearised.solve(normal, np.append(slope, 0.0))


def _left(before: float, between: float, after: float) -> float:
    """Return what steps to come change, over the second of two, from the residuals.

    Infinite where they lead away.
    """
    if after <= SURE * between:
        return after / (between - after) if between > 0.0 else 0.0
    return math.inf if after > DEPARTS * before else 1.0


def _beyond(share: float, harmonics: int) -> float:
    """Return what still more harmonics would change, over what the last octave did.

    ``share`` is that of the impulses: higher orders answer those, and act back on the
    lower ones by what decays alike.
    """
    if harmonics < FEW:
        return (WARY * share) ** 2
    return min(2.0, (SAFE * share) ** 2)


class PathResolution(Resolution):
    """A path at any number of harmonics and samples, made when first asked for."""

    def __init__(self, path: Path, probes: Array) -> None:
        """Resolve ``path``; its points are judged by the amplitude of the probes.

        ``probes`` has shape ``(probes, dofs)``.
        """
        self._path, self._probes = path, probes
        self.rank = path.rank
        self._made: dict[FourierBasis, Balance] = {}

    def at(self, fourier: FourierBasis) -> Balance:
        """Return the system at one resolution."""
        if fourier not in self._made:
            self._made[fourier] = self._path.balance(fourier)
        return self._made[fourier]

    def amplitudes(self, point: Array) -> Array:
        """Return the first-harmonic amplitude of each probe [m]."""
        return np.abs(self.phasors(point))

    def phasors(self, point: Array) -> ComplexArray:
        """Return the first harmonic of each probe [m]."""
        rank = self.rank
        first = point[rank : 2 * rank] - 1j * point[2 * rank : 3 * rank]
        problem, frequency = self._path.at(float(point[-1]))
        return problem.first_harmonic(first, frequency, self._probes)
