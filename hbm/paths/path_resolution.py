"""A path at any number of harmonics and samples, judged by what probes see (§6.3)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hbm.balance.balance import Balance
from hbm.continuation.arc import plane_across
from hbm.forces.fourier import FourierBasis
from hbm.paths.path import Path
from hbm.paths.path_metric import path_metric
from hbm.resolution.resolution import Resolution
from microslip_mechanics.arrays import Array, ComplexArray

CREEPS = 100.0
"""times the creep of rigid contacts that stick, up to which a motion is nothing else"""


class PathResolution(Resolution):
    """A path at any number of harmonics and samples, made when first asked for."""

    def __init__(self, path: Path, probes: Array, *, marched: bool = False) -> None:
        """Resolve ``path``; its points are judged by the amplitude of the probes.

        ``probes`` has shape ``(probes, dofs)``; ``marched`` is that of a resolution.
        """
        self._path, self._probes, self.marched = path, probes, marched
        self.rank = path.rank
        self._made: dict[FourierBasis, Balance] = {}

    def in_all(self) -> tuple[PathResolution, NDArray[np.int64]]:
        """Return that in all coordinates and orders, and which of them are kept."""
        path, kept = self._path.in_all()
        if path is self._path:
            return self, kept
        return PathResolution(path, self._probes, marched=self.marched), kept

    def mask(self, harmonics: int) -> NDArray[np.bool_]:
        """Return the active coefficients, shape (2 harmonics + 1, rank)."""
        return self._path.mask(harmonics)

    def at(self, fourier: FourierBasis) -> Balance:
        """Return the system at one resolution."""
        if fourier not in self._made:
            self._made[fourier] = self._path.balance(fourier)
        return self._made[fourier]

    def least(self, point: Array) -> float:
        """Return what rigid contacts creep at most, many times [m]; 0 without any."""
        problem, frequency = self._path.at(float(point[-1]))
        if problem.tractions is None:
            return 0.0
        drive = float(np.linalg.norm(problem.force[1]))
        return CREEPS * problem.tractions.creep(frequency, drive)

    def across(self, along: Array, point: Array) -> Array:
        """Return the normal of the plane through a point across a curve's tangent."""
        return plane_across(along, path_metric(self._path, point))

    def amplitudes(self, points: Sequence[Array]) -> Array:
        """Return the first-harmonic amplitude of each probe [m], (points, probes)."""
        return np.abs(self.phasors(points))

    def phasors(self, points: Sequence[Array]) -> ComplexArray:
        """Return the first harmonic of each probe [m], (points, probes)."""
        rank, places = self.rank, [float(point[-1]) for point in points]
        table = np.array([point[rank : 3 * rank] for point in points])
        first = table[:, :rank] - 1j * table[:, rank:]
        ways = {place: self._path.at(place) for place in places}
        problem, _ = ways[places[0]]
        if all(other is problem for other, _ in ways.values()):
            frequencies = np.array([ways[place][1] for place in places])
            return problem.first_harmonic(first, frequencies, self._probes)
        return np.vstack([self.phasors([point]) for point in points])
