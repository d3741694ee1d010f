"""A path at one place of another, from an easier problem to the whole one (§6.2)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hbm.balance.parametric import ParametricBalance
from hbm.balance.relative import RelativeProblem
from hbm.continuation.correction import Correction
from hbm.errors import PLACE, ContinuationError
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import Path
from hbm.stability.stability import SmallMotions
from microslip_mechanics.arrays import Array

LEAST, UNIT = 0.01, 0.1
"""drive at which a curve may begin, over the whole, and what counts as one unit of a
share"""
Easier: TypeAlias = Callable[[RelativeProblem, float], RelativeProblem]
"""problem, share of the way to it ↦ an easier one"""


def driven(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem under a share of its drive."""
    return replace(problem, force=problem.force * np.array([[1.0], [share]]))


@dataclass(frozen=True, slots=True)
class AlongShare:
    """The share of the way to a problem changes; that of its drive, if left out."""

    path: Path
    place: float
    """parameter of the path"""
    easier: Easier = driven
    least: float = -1.0
    """least share; from minus the whole drive to the whole"""
    free: bool = False
    """whether it begins with the motion without contacts, not at rest"""
    known: Array | None = None
    """coefficients to begin with instead, shape (2H + 1, rank), if they are known"""

    @property
    def rank(self) -> int:
        """Number of relative coordinates that move."""
        return self.path.rank

    def at(self, parameter: float) -> tuple[RelativeProblem, float]:
        """Return the problem at a share, and the frequency [rad/s]."""
        problem, frequency = self.path.at(self.place)
        return self.easier(problem, parameter), frequency

    def begins(self, parameter: float) -> Array:
        """Return coefficients to begin with at a share, shape (3, rank) or more."""
        if self.known is not None:
            return self.known
        problem, frequency = self.at(parameter)
        still = np.zeros((3, problem.rank))
        still[0] = problem.rest
        if self.free:
            moved = problem.moved_apart(frequency)
            still[1:] = moved.real, -moved.imag
        return still

    def mask(self, harmonics: int) -> NDArray[np.bool_]:
        """Return the active coefficients, shape (2 harmonics + 1, rank)."""
        return self.path.mask(harmonics)

    def in_all(self) -> tuple[AlongShare, NDArray[np.int64]]:
        """Return the path in all coordinates and orders, and which of them are kept."""
        path, kept = self.path.in_all()
        return self if path is self.path else replace(self, path=path), kept

    def balance(self, fourier: FourierBasis) -> ParametricBalance:
        """Return harmonic balance at one resolution."""
        mask = self.mask(fourier.harmonics)
        limits = self.least, 1.0
        return ParametricBalance(self.at, fourier, mask, self.unit, limits)

    def unit(self, parameter: float) -> float:  # noqa: ARG002
        """Return the change that counts as one unit of arc."""
        return UNIT

    def measure(self, vibration: float, parameter: float) -> float:  # noqa: ARG002
        """Return the vibration itself."""
        return vibration

    def motions(self, parameter: float) -> SmallMotions:  # noqa: ARG002
        """Return the structure for small motions."""
        return self.path.motions(self.place)


def arrived(ways: Iterable[Callable[[], Array]]) -> Iterator[Array]:
    """Yield what each way to a whole problem returns, if it does not fail."""
    for way in ways:
        try:
            yield way()
        except ContinuationError:
            continue


def whole(corrections: Iterable[Correction], place: float) -> Array:
    """Return the last point of a path along a share, at a place of another.

    Raises
    ------
    ContinuationError
        If the share is not the whole there.
    """
    for last in corrections:
        point = last.point
    if point[-1] < 1.0:
        raise ContinuationError(f"the drive falls again at {PLACE}", place)
    return point
