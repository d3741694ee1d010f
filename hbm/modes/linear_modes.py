"""Linear modes: free decaying motions about rest, contacts sticking (theory §6.8)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hbm.balance.relative import RelativeProblem
from hbm.forces.fourier import FourierBasis
from hbm.structure.poles import eigenpairs
from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.by_value import ByValue
from microslip_mechanics.problem import Problem

SEEN = 1e-6
"""part of a shape of unit length that the probes see at least"""


@dataclass(frozen=True, slots=True, eq=False)
class FreeDecay(ByValue):
    """A free motion that oscillates and decays."""

    pole: complex
    """s [rad/s]: −decay rate + i frequency of the damped motion"""

    @property
    def frequency(self) -> float:
        """Natural frequency |s| [rad/s]."""
        return abs(self.pole)

    @property
    def damping(self) -> float:
        """Damping ratio."""
        return -self.pole.real / abs(self.pole)

    def __repr__(self) -> str:
        """Return what motion it is, in a line."""
        return (
            f"<{type(self).__name__}: {self.frequency / math.tau:.6g} Hz, "
            f"damping ratio {self.damping:.4g}>"
        )


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class LinearMode(FreeDecay):
    """Re φ exp(st): a motion so small that the contacts are springs and dashpots."""

    shape: ComplexArray
    """φ, whose largest probe is one, shape (dofs,)"""


def linear_modes(
    problem: Problem, relative: RelativeProblem, lowest: float, highest: float
) -> list[LinearMode]:
    """Return the modes with a natural frequency within a range, the lowest first.

    Parameters
    ----------
    problem
        The structure; its drive is not used.
    relative
        The same problem in relative coordinates, about its rest.
    lowest, highest
        Of the natural frequencies [rad/s].

    Notes
    -----
    Overdamped motions have no frequency and are left out, and so is what no probe sees.
    """
    stiffness, damping = _about_rest(problem, relative)
    poles, shapes = eigenpairs(problem.structure.mass, damping, stiffness)
    inside = (poles.imag > 0.0) & (np.abs(poles) >= lowest) & (np.abs(poles) <= highest)
    found = []
    for place in np.flatnonzero(inside):
        shape = shapes[:, place] / np.linalg.norm(shapes[:, place])
        seen = problem.probes.rows @ shape
        largest = seen[np.abs(seen).argmax()]
        if abs(largest) > SEEN:
            found.append(LinearMode(complex(poles[place]), shape / largest))
    return sorted(found, key=lambda mode: mode.frequency)


def _about_rest(problem: Problem, relative: RelativeProblem) -> tuple[Array, Array]:
    """Return stiffness and damping of the structure with its contacts at rest."""
    contact = relative.contact(FourierBasis(1, 8))
    contact(np.vstack([relative.rest, np.zeros((2, relative.rank))]), 1.0)
    elastic, viscous = contact.small_tangents()
    select, structure = relative.selection, problem.structure
    return (
        structure.stiffness + select.T @ elastic @ select,
        structure.damping + select.T @ viscous @ select,
    )
