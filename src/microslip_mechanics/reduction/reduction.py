"""A large sparse problem in few coordinates, and what that leaves out (theory §6.1).

Fixed-interface modes after Craig and Bampton (1968) with residual vectors.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.interface import Interface
from microslip_mechanics.problem import Probes, Problem
from microslip_mechanics.reduction.residual_vectors import residual_vectors
from microslip_mechanics.structures.projected_structure import projected
from microslip_mechanics.structures.stuck import stuck_structure
from microslip_mechanics.structures.stuck_modes import loss_beside, stuck_modes

MARGIN = 2.0
"""modes are kept up to this multiple of the highest frequency that is wanted"""


class Truncation(NamedTuple):
    """What the modes leave out of the static responses to the loads."""

    limit: float
    """no mode left out is slower [rad/s]; infinite if none is"""
    damping: float
    """largest ratio of damping to stiffness of what is left out [s]"""
    energy: Array
    """left out, twice, of responses to preload, drive, M T and C T; (loads, loads)

    The drive is two loads if it is complex.
    """


@dataclass(frozen=True, slots=True)
class Reduction:
    """A problem with a dense structure in place of one with a sparse structure."""

    whole: Problem
    problem: Problem
    """in coordinates: relative motion first, then modes of the stuck structure"""
    shapes: Array
    """motion of each coordinate, shape (dofs, coordinates)"""
    truncation: Truncation

    def coordinates(self, displacement: Array) -> Array:
        """Return the coordinates of a displacement, (dofs,), that they can show."""
        momenta = self.shapes.T @ (self.whole.structure.mass @ displacement)
        found: Array = np.linalg.solve(self.problem.structure.mass, momenta)
        return found

    def error(self, frequency: float) -> tuple[float, float]:
        """Return a bound of what truncation changes at a frequency [rad/s].

        It is one where the damping does not couple the modes, an estimate otherwise;
        infinite from the slowest mode left out on (theory §6.1).

        Returns
        -------
        stiffness
            Largest change of the dynamic stiffness of the relative motion [N/m].
        load
            Of the load on it by the drive [N].
        """
        kept = self.truncation
        rank = (len(kept.energy) - 2) // 2
        if not frequency < kept.limit:
            return np.inf, np.inf
        ratio = (frequency / kept.limit) ** 2
        loss = frequency * kept.damping
        share = (1.0 + loss / (1.0 - ratio)) ** 3 * (ratio + loss) ** 2 / (1.0 - ratio)
        inertia = np.vstack([frequency**2 * np.eye(rank), frequency * np.eye(rank)])
        first = len(kept.energy) - 2 * rank
        moved = inertia.T @ np.abs(kept.energy[first:, first:]) @ inertia
        stiffness = share * float(np.linalg.norm(moved, 2)) if rank else 0.0
        drive = share * float(kept.energy.diagonal()[1:first].sum())
        return stiffness, float(np.sqrt(stiffness * drive))


def reduced(problem: Problem, highest: float) -> Reduction:
    """Return a problem with the modes that matter up to a frequency.

    Static responses are exact, however few the modes.

    Parameters
    ----------
    problem
        Its structure is sparse.
    highest
        Frequency up to which the motion is wanted [rad/s]; zero for statics alone.

    Raises
    ------
    ValueError
        If the structure can move freely while all contacts stick, has too many modes,
        or is gyroscopic.
    """
    if problem.structure.gyroscopic:
        raise ValueError(
            "a sparse structure with gyroscopic forces: give dense matrices, or reduce "
            "it first by microslip.reduced_problem"
        )
    basis, selection = problem.interface.relative_motion()
    stuck = stuck_structure(problem.structure, selection)
    modes = stuck_modes(stuck, MARGIN * highest)
    inertia, friction = (
        stuck.free.T @ (matrix @ stuck.static)
        for matrix in (problem.structure.mass, problem.structure.damping)
    )
    drive = (
        [problem.drive.real]
        if problem.in_phase
        else [problem.drive.real, problem.drive.imag]
    )
    loads = stuck.free.T @ np.stack([problem.preload, *drive], axis=1)
    residual, energy = residual_vectors(
        stuck, modes, np.hstack([loads, inertia, friction])
    )
    shapes = np.hstack([stuck.static, stuck.free @ np.hstack([modes.shapes, residual])])
    damping = loss_beside(stuck, modes) if 0.0 < modes.next < np.inf else 0.0
    return Reduction(
        problem,
        _projected(problem, basis, shapes),
        shapes,
        Truncation(modes.next, damping, energy),
    )


def _projected(problem: Problem, basis: Array, shapes: Array) -> Problem:
    """Return the problem in the coordinates of shapes, (dofs, coordinates)."""
    rank, count = basis.shape[1], shapes.shape[1]
    names = tuple(f"relative {place + 1}" for place in range(rank))
    names += tuple(f"stuck {place + 1}" for place in range(count - rank))
    seen = np.hstack([basis, np.zeros((len(basis), count - rank))])
    return replace(
        problem,
        structure=projected(problem.structure, shapes, rank, names),
        interface=Interface(problem.interface.points, seen, problem.interface.names),
        preload=shapes.T @ problem.preload,
        drive=shapes.T @ problem.drive,
        probes=Probes(problem.probes.names, problem.probes.rows @ shapes),
    )
