"""A beam element in rotating axes; the stiffness by its tension (theory §9)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.structures.beam import RectangularSection
from microslip_mechanics.structures.rotating_part import RotatingPart

PLACES, WEIGHTS = np.polynomial.legendre.leggauss(4)
"""exact for products of two deflections, and of two slopes by the tension"""


def rotating_beam(
    section: RectangularSection, length: float, spin: Array, root: Array
) -> RotatingPart:
    """Return load, softening and Coriolis matrix of an element in local axes.

    Parameters
    ----------
    section, length
        Of the element [m].
    spin
        W, the cross product with Ω in local axes [rad/s], shape ``(3, 3)``.
    root
        Start of the element minus a point of the axis of rotation, local axes [m].

    Notes
    -----
    Displacements are those of the consistent mass, so sections have no inertia in
    bending; in torsion they have, and turn towards the plane of rotation.
    """
    load, softening, coriolis = np.zeros(12), np.zeros((12, 12)), np.zeros((12, 12))
    square, turn = spin @ spin, _torsion(section, spin)
    for place, weight in zip(PLACES, WEIGHTS, strict=True):
        along = (place + 1.0) / 2.0
        moved, twist = _displacement(along, length), _twist(along)
        line = section.density * section.area * weight * length / 2.0
        share = section.density * weight * length / 2.0
        centre = root + np.array([along * length, 0.0, 0.0])
        load -= line * moved.T @ (square @ centre)
        load -= share * turn[0] * twist
        softening += line * moved.T @ square @ moved
        softening += share * turn[1] * np.outer(twist, twist)
        coriolis += 2.0 * line * moved.T @ spin @ moved
    return RotatingPart(load, softening, coriolis)


def tension_stiffness(
    section: RectangularSection, length: float, spin: Array, root: Array, mean: float
) -> Array:
    """Return the stiffness of an element under centrifugal tension, shape (12, 12).

    The tension falls along the element by what acts on it; ``mean`` [N] is its mean.
    Slopes and twist lengthen the fibres: N w'² and N (I_y + I_z)/A θ'².
    """
    pull = -section.density * section.area * (spin @ spin)[0]
    polar = (section.inertia_y + section.inertia_z) / section.area
    found = np.zeros((12, 12))
    rate = (_twist(1.0) - _twist(0.0)) / length
    for place, weight in zip(PLACES, WEIGHTS, strict=True):
        x = (place + 1.0) / 2.0 * length
        tension = mean - (pull @ root) * (x - length / 2.0)
        tension -= pull[0] * (x**2 / 2.0 - length**2 / 6.0)
        slopes = _slopes(x / length, length)
        bent = slopes.T @ slopes + polar * np.outer(rate, rate)
        found += weight * length / 2.0 * tension * bent
    return found


def stretch(section: RectangularSection, length: float) -> Array:
    """Return the map from an element's motion to its mean tension [N], shape (12,)."""
    row = np.zeros(12)
    row[0], row[6] = -1.0, 1.0
    found: Array = section.young_modulus * section.area / length * row
    return found


def _torsion(section: RectangularSection, spin: Array) -> tuple[float, float]:
    """Return torque and its change with the twist by ρ and length (propeller moment).

    A twisted section has the potential −½ ρ ∫ |Ω × d|² dA.
    """
    across, up = spin[0, 2], -spin[0, 1]
    span = section.inertia_z - section.inertia_y
    return across * up * span, (up**2 - across**2) * span


def _displacement(along: float, length: float) -> Array:
    """Return the map to the displacement at a share of the length, shape (3, 12)."""
    first, second = 1.0 - along, along
    rows = np.zeros((3, 12))
    rows[0, [0, 6]] = first, second
    shapes = np.array(
        [
            1.0 - 3.0 * along**2 + 2.0 * along**3,
            length * (along - 2.0 * along**2 + along**3),
            3.0 * along**2 - 2.0 * along**3,
            length * (along**3 - along**2),
        ]
    )
    rows[1, [1, 5, 7, 11]] = shapes
    rows[2, [2, 4, 8, 10]] = shapes * [1.0, -1.0, 1.0, -1.0]
    return rows


def _slopes(along: float, length: float) -> Array:
    """Return the map to the slopes of both deflections, shape (2, 12)."""
    rows = np.zeros((2, 12))
    shapes = np.array(
        [
            6.0 * (along**2 - along) / length,
            1.0 - 4.0 * along + 3.0 * along**2,
            6.0 * (along - along**2) / length,
            3.0 * along**2 - 2.0 * along,
        ]
    )
    rows[0, [1, 5, 7, 11]] = shapes
    rows[1, [2, 4, 8, 10]] = shapes * [1.0, -1.0, 1.0, -1.0]
    return rows


def _twist(along: float) -> Array:
    """Return the map to the twist, shape (12,)."""
    row = np.zeros(12)
    row[[3, 9]] = 1.0 - along, along
    return row
