"""Three-dimensional Euler–Bernoulli beam element, consistent mass (theory §1)."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from microslip_mechanics.arrays import Array


@dataclass(frozen=True, slots=True)
class RectangularSection:
    """Rectangular cross section of a homogeneous isotropic beam along local x."""

    width: float
    """extent along local y [m]"""
    thickness: float
    """extent along local z [m]"""
    young_modulus: float
    """E [Pa]"""
    poisson_ratio: float
    density: float
    """ρ [kg/m³]"""

    @property
    def area(self) -> float:
        """A [m²]."""
        return self.width * self.thickness

    @property
    def inertia_y(self) -> float:
        """Second moment of area about local y [m⁴]: bending along z."""
        return self.width * self.thickness**3 / 12.0

    @property
    def inertia_z(self) -> float:
        """Second moment of area about local z [m⁴]: bending along y."""
        return self.thickness * self.width**3 / 12.0

    @property
    def shear_modulus(self) -> float:
        """G [Pa]."""
        return self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def torsion_constant(self) -> float:
        """Saint-Venant's J [m⁴]: Timoshenko & Goodier, Theory of Elasticity, §109."""
        long, short = sorted((self.width, self.thickness), reverse=True)
        series = sum(
            math.tanh(n * math.pi * long / (2.0 * short)) / n**5
            for n in range(1, 40, 2)
        )
        slender = 1.0 - 192.0 / math.pi**5 * short / long * series
        return long * short**3 / 3.0 * slender


def beam_matrices(section: RectangularSection, length: float) -> tuple[Array, Array]:
    """Return stiffness and consistent mass of one element in local axes.

    Parameters
    ----------
    section
        Cross section and material.
    length
        Element length [m].

    Returns
    -------
    stiffness, mass
        Shape ``(12, 12)``; per end the three displacements [m] and three rotations
        [rad]: ``ux, uy, uz, rx, ry, rz``.

    References
    ----------
    Theory page, eqs. (1)–(3).
    """
    modulus, per_length = section.young_modulus, section.density * length
    stiffness, mass = np.zeros((12, 12)), np.zeros((12, 12))
    rod, rod_mass = np.array([[1.0, -1.0], [-1.0, 1.0]]), np.array([[2.0, 1], [1, 2]])
    for dof, rigidity, inertia in (
        (0, modulus * section.area, section.area),
        (
            3,
            section.shear_modulus * section.torsion_constant,
            section.inertia_y + section.inertia_z,
        ),
    ):
        pair = np.ix_([dof, dof + 6], [dof, dof + 6])
        stiffness[pair] = rigidity / length * rod
        mass[pair] = per_length * inertia / 6.0 * rod_mass
    for deflection, rotation, sign, inertia in (
        (1, 5, 1.0, section.inertia_z),
        (2, 4, -1.0, section.inertia_y),
    ):
        plane = [deflection, rotation, deflection + 6, rotation + 6]
        bending, inertial = _bending(length, sign)
        stiffness[np.ix_(plane, plane)] = modulus * inertia / length**3 * bending
        mass[np.ix_(plane, plane)] = per_length * section.area / 420.0 * inertial
    return stiffness, mass


def _bending(length: float, sign: float) -> tuple[Array, Array]:
    """Return the Hermite bending shapes; ``sign`` is that of slope over rotation."""
    arm = sign * length
    bending = np.array(
        [
            [12.0, 6 * arm, -12, 6 * arm],
            [6 * arm, 4 * arm**2, -6 * arm, 2 * arm**2],
            [-12, -6 * arm, 12, -6 * arm],
            [6 * arm, 2 * arm**2, -6 * arm, 4 * arm**2],
        ]
    )
    inertial = np.array(
        [
            [156.0, 22 * arm, 54, -13 * arm],
            [22 * arm, 4 * arm**2, 13 * arm, -3 * arm**2],
            [54, 13 * arm, 156, -22 * arm],
            [-13 * arm, -3 * arm**2, -22 * arm, 4 * arm**2],
        ]
    )
    return bending, inertial
