"""Potential energy of a structure at rest on its normal contacts (theory §5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.normal import contact_energy, normal_response
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import kernel
from microslip_mechanics.problem import Problem


class Potential(NamedTuple):
    """Potential energy of a displacement under the preload, and its derivatives."""

    energy: float
    """[J]"""
    normal_force: Array
    """[N], shape (points,)"""
    gradient: Array
    """forces that are not balanced [N], shape (dofs,)"""
    hessian: Array
    """[N/m], shape (dofs, dofs)"""


def potential(problem: Problem, state: Array) -> Potential:
    """Return the potential energy of a displacement [m], shape (dofs,)."""
    normals = problem.interface.displacement[0::3]
    elastic = problem.structure.stiffness @ state
    energies, forces, stiffness = _normal_springs(
        problem.interface.points, normals @ state
    )
    energy = state @ (0.5 * elastic - problem.preload) + energies.sum()
    gradient = elastic + normals.T @ forces - problem.preload
    hessian = problem.structure.stiffness + (normals.T * stiffness) @ normals
    return Potential(float(energy), forces, gradient, hessian)


@kernel
def _normal_springs(
    points: ContactPoints, penetration: Array
) -> tuple[Array, Array, Array]:
    """Return elastic energy, normal force and normal stiffness of points at rest."""
    energy = np.zeros(penetration.size)
    force = np.zeros(penetration.size)
    stiffness = np.zeros(penetration.size)
    for point in range(penetration.size):
        force[point], stiffness[point], _ = normal_response(
            points, point, penetration[point], 0.0
        )
        energy[point] = contact_energy(points, point, penetration[point])
    return energy, force, stiffness
