"""A path along the drive at one place of another path (theory §6.2)."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

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
"""drive at which a curve may begin and what counts as one unit of it, over the whole"""


@dataclass(frozen=True, slots=True)
class AlongDrive:
    """The share of the drive changes, from minus the whole to the whole."""

    path: Path
    place: float
    """parameter of the path"""

    @property
    def rank(self) -> int:
        """Number of relative coordinates that move."""
        return self.path.rank

    def at(self, parameter: float) -> tuple[RelativeProblem, float]:
        """Return the problem under a share of the drive, and the frequency [rad/s]."""
        problem, frequency = self.path.at(self.place)
        return driven(problem, parameter), frequency

    def mask(self, harmonics: int) -> NDArray[np.bool_]:
        """Return the active coefficients, shape (2 harmonics + 1, rank)."""
        return self.path.mask(harmonics)

    def in_all(self) -> tuple[AlongDrive, NDArray[np.int64]]:
        """Return the path in all coordinates and orders, and which of them are kept."""
        path, kept = self.path.in_all()
        return self if path is self.path else replace(self, path=path), kept

    def balance(self, fourier: FourierBasis) -> ParametricBalance:
        """Return harmonic balance at one resolution."""
        mask = self.mask(fourier.harmonics)
        return ParametricBalance(self.at, fourier, mask, self.unit, (-1.0, 1.0))

    def unit(self, parameter: float) -> float:  # noqa: ARG002
        """Return the change that counts as one unit of arc."""
        return UNIT

    def motions(self, parameter: float) -> SmallMotions:  # noqa: ARG002
        """Return the structure for small motions."""
        return self.path.motions(self.place)


def driven(problem: RelativeProblem, share: float) -> RelativeProblem:
    """Return the problem under a share of its drive."""
    return replace(problem, force=problem.force * np.array([[1.0], [share]]))


def whole_drive(corrections: Iterable[Correction], place: float) -> Array:
    """Return the last point of a path along the drive, at a place of another.

    Raises
    ------
    ContinuationError
        If the drive is not the whole one there.
    """
    for last in corrections:
        point = last.point
    if point[-1] < 1.0:
        raise ContinuationError(f"the drive falls again at {PLACE}", place)
    return point
