"""Contacts as springs and dampers that do the same in one harmonic (theory §6.7)."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from hbm.forces.aft import AlternatingFrequencyTime
from hbm.forces.fourier import FourierBasis, to_complex
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.contact.points import FRICTIONLESS
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import StaticState
from microslip_mechanics.structures.structure import Structure

SAMPLES = 1024
"""of the contacts per period"""
STILL = 1e-9
"""amplitude over the largest one, up to which a coordinate is at rest"""


@dataclass(frozen=True, slots=True)
class EquivalentContact:
    """A spring and a damper along each row of the interface's displacement."""

    stiffness: Array
    """[N/m], shape (3 points,)"""
    damping: Array
    """[N s/m], shape (3 points,)"""

    def only(self, rows: NDArray[np.bool_]) -> EquivalentContact:
        """Return the same with nothing along all other rows."""
        return EquivalentContact(
            np.where(rows, self.stiffness, 0.0), np.where(rows, self.damping, 0.0)
        )

    def joined(self, problem: Problem) -> Structure:
        """Return the structure, which is not sparse, with these springs and dampers."""
        rows, structure = problem.interface.displacement, problem.structure.dense
        return replace(
            structure,
            damping=structure.damping + (rows.T * self.damping) @ rows,
            stiffness=structure.stiffness + (rows.T * self.stiffness) @ rows,
        )


def equivalent_contact(
    problem: Problem, response: PeriodicResponse
) -> EquivalentContact:
    """Return the describing function of each contact coordinate (theory §6.7).

    Mean and first harmonic of the response count. A coordinate at rest gets the mean
    of its tangents over the period: what a small motion at another frequency feels (at
    the same one, of what contacts remember).
    """
    motion = response.seen(problem.interface.displacement)[:3]
    force, tangents = _evaluated(problem, motion, response.frequency, response.samples)
    stiffness, damping = tangents.stiffness.copy(), tangents.damping.copy()
    moved, felt = to_complex(motion)[1], to_complex(force)[1]
    moves = np.abs(moved) > STILL * np.abs(moved).max(initial=0.0)
    quotient = felt[moves] / moved[moves]
    stiffness[moves], damping[moves] = quotient.real, quotient.imag / response.frequency
    return EquivalentContact(stiffness, damping)


def free_structure(problem: Problem, rest: StaticState) -> Structure:
    """Return the structure on the normal contacts of the equilibrium alone."""
    normal = np.arange(3 * problem.interface.count) % 3 == 0
    return _at_rest(problem, rest).only(normal).joined(problem)


def stuck_structure(problem: Problem, rest: StaticState) -> Structure | None:
    """Return the same without any sliding where there is friction.

    Friction that remembers is a spring as long as nothing slides. None if nothing can
    move any more.
    """
    points, rows = problem.interface.points, problem.interface.displacement
    loaded = (rest.normal_force > 0.0) | points.constant_load
    springs = remembers(points)
    tied = np.repeat((points.friction != FRICTIONLESS) & loaded & ~springs, 3)
    tied[::3] = False
    held = np.repeat(springs, 3)
    held[::3] = True
    whole = _at_rest(problem, rest).only(held).joined(problem)
    kept = np.eye(whole.dofs)
    if tied.any():
        kept = scipy.linalg.null_space(rows[tied])
    if kept.shape[1] == 0:
        return None
    return Structure(
        kept.T @ whole.mass @ kept,
        kept.T @ whole.damping @ kept,
        kept.T @ whole.stiffness @ kept,
        tuple(f"motion {number}" for number in range(kept.shape[1])),
        whole.gyroscopic,
    )


def _at_rest(problem: Problem, rest: StaticState) -> EquivalentContact:
    """Return the tangents at the equilibrium."""
    rows = problem.interface.displacement
    motion = np.zeros((3, len(rows)))
    motion[0] = rows @ rest.displacement
    return _evaluated(problem, motion, 1.0, SAMPLES)[1]


def _evaluated(
    problem: Problem, motion: Array, frequency: float, samples: int
) -> tuple[Array, EquivalentContact]:
    """Return coefficients of the points' forces [N] and their mean tangents."""
    points = problem.interface.points
    fourier = FourierBasis(1, samples)
    contact = AlternatingFrequencyTime(points, np.eye(motion.shape[1]), fourier)
    force = contact(motion, frequency)
    return force, EquivalentContact(*map(np.diagonal, contact.small_tangents()))
