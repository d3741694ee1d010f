"""The unknowns of a nonlinear mode: their places and their scale (theory §6.8)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hbm.modes.modal_parts import ModalParts
from microslip_mechanics.arrays import Array, ComplexArray

STRIDE = 0.01
"""change of the pole, over that of the linear mode, that counts as one unit of arc"""
FARTHER = 0.2
"""change of the pole, over that since the linear mode, that does so where it is more"""
FARTHEST = 60.0
"""of log a, either way, that a trial may go"""
FAINT = 1e-2
"""relative motion over the amplitude, below which its changes count less"""


@dataclass(frozen=True, slots=True)
class ModalUnknowns:
    """What the components of a point mean.

    A point is the flat array of coefficients, shape (2H + 1, rank + count + 1),
    followed by log a. The columns are (y − rest)/a, then η/a and s over the modulus of
    the linear pole, which have order 1 alone. It may carry more harmonics than are
    solved for: those are ignored.
    """

    active: NDArray[np.bool_]
    """coefficients of y that are sought, (2H + 1, rank)"""
    count: int
    """of η"""
    pole: complex
    """of the linear mode"""

    @property
    def rank(self) -> int:
        """Number of relative coordinates."""
        return int(self.active.shape[1])

    @property
    def width(self) -> int:
        """Number of columns."""
        return self.rank + self.count + 1

    @property
    def places(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Places of the unknowns in a point: those of y, then those of η and s."""
        wide = np.arange(len(self.active) * self.width).reshape(-1, self.width)
        return wide[:, : self.rank][self.active], wide[1:3, self.rank :].ravel()

    def point(self, parts: ModalParts, size: int) -> Array:
        """Return the point of some parts, with ``size`` components."""
        point = np.zeros(size)
        table = point[:-1].reshape(-1, self.width)
        table[: len(parts.shape), : self.rank] = parts.shape
        pole = parts.pole / abs(self.pole)
        table[1:3, self.rank :] = pair(np.append(parts.modal, pole))
        point[-1] = math.log(parts.amplitude)
        return point

    def parts(self, point: Array) -> ModalParts:
        """Return what a point means."""
        table = point[:-1].reshape(-1, self.width)[: len(self.active)]
        values = table[1, self.rank :] - 1j * table[2, self.rank :]
        return ModalParts(
            np.where(self.active, table[:, : self.rank], 0.0),
            values[:-1],
            complex(values[-1] * abs(self.pole)),
            math.exp(min(max(point[-1], -FARTHEST), FARTHEST)),
        )

    def metric(self, point: Array) -> Array:
        """Return the change of each component that counts as one unit of arc.

        Relative changes of the relative motion and of the amplitude each, and
        :data:`STRIDE` of the linear mode's pole, or :data:`FARTHER` of how far the pole
        has moved if that is more.
        """
        table = point[:-1].reshape(-1, self.width)
        scale = np.ones_like(table)
        scale[:, : self.rank] = np.linalg.norm(table[1:, : self.rank]) + FAINT
        moved = table[1:3, -1] - pair(np.array(self.pole / abs(self.pole)))
        scale[:, -1] = max(STRIDE, FARTHER * float(np.linalg.norm(moved)))
        return np.append(scale.ravel(), 1.0)


def pair(values: ComplexArray) -> Array:
    """Return real parts and negative imaginary parts, as rows."""
    return np.stack([values.real, -values.imag])
