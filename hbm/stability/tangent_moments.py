"""Moments of the contact tangents in an interval of a period (theory §6.4).

The mean A₀, the tilt A₁, and what a straight line leaves of the tangents A, each of the
points for itself.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from hbm.forces.contact_path import ContactPath, place
from hbm.stability.brief_touches import BRIEFLY
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.law import contact_force
from microslip_mechanics.contact.points import ContactPoints
from microslip_mechanics.jit import bare_kernel, inner_kernel, kernel

STIFF = 1.0
"""damping of a point that sticks, times the time that it is given, over its inertia"""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(5)
_INSIDE = 0.5 * (1.0 + _NODES)
# gathered at both ends, where the tangent of a contact that closes is like 1/√t
PLACES = _INSIDE**2 * (3.0 - 2.0 * _INSIDE)
MEAN = 3.0 * _WEIGHTS * _INSIDE * (1.0 - _INSIDE)
TILT = MEAN * (PLACES - 0.5)
BEND = MEAN * (6.0 * (PLACES - 0.5) ** 2 - 0.5)
"""weights of A₀, of A₁, and of what a straight line leaves of A"""


@kernel
def write_moments(
    points: ContactPoints,
    path: ContactPath,
    begin: float,
    length: float,
    moments: Array,
) -> None:
    """Write mean, tilt and bend of the tangents of each point in an interval.

    ``moments`` has shape ``(points, 3, 2, 3, 3)``: the last are those by displacement
    and those by velocity.
    """
    moved, moving, force = np.zeros(3), np.zeros(3), np.zeros(3)
    tangents = np.zeros((2, 3, 3))
    moments[:] = 0.0
    for point in range(points.load.size):
        for node in range(PLACES.size):
            at = begin + length * PLACES[node]
            place(path, point, at, moved, moving)
            contact_force(points, point, moved, moving, force, tangents[0], tangents[1])
            for kind in range(2):
                for row in range(3):
                    for column in range(3):
                        size = tangents[kind, row, column]
                        moments[point, 0, kind, row, column] += MEAN[node] * size
                        moments[point, 1, kind, row, column] += TILT[node] * size
                        moments[point, 2, kind, row, column] += BEND[node] * size


@bare_kernel
def largest_change(moments: Array, inertia: Array, length: float) -> float:
    """Return by how much the tangents of a point change, beside what holds it."""
    largest = 0.0
    for point in range(moments.shape[0]):
        for row in range(3):
            held, change = inertia[3 * point + row], 0.0
            for kind, scale in ((0, length * length), (1, length)):
                held += scale * abs(moments[point, 0, kind, row, row])
                for column in range(3):
                    change += scale * (
                        abs(moments[point, 1, kind, row, column])
                        + abs(moments[point, 2, kind, row, column])
                    )
            largest = max(largest, change / held)
    return largest


@bare_kernel
def largest_phase(
    moments: Array, inertia: Array, touched: Array, length: float
) -> float:
    """Return by what angle a point vibrates on its normal stiffness at most [rad].

    Those count that are ``touched`` so briefly that it matters.
    """
    largest = 0.0
    for point in range(moments.shape[0]):
        rate = math.sqrt(abs(moments[point, 0, 0, 0, 0]) / inertia[3 * point])
        if rate * touched[point] <= BRIEFLY:
            largest = max(largest, rate * length)
    return largest


@bare_kernel
def caught(
    moments: Array,
    inertia: Array,
    brief: float,
    held: NDArray[np.bool_],
) -> bool:
    """Write which points damping holds; return whether one was not held before."""
    begins = False
    for point in range(moments.shape[0]):
        for axis in range(3):
            row = 3 * point + axis
            damping = brief * moments[point, 0, 1, axis, axis]
            catches = damping > STIFF * inertia[row]
            begins = begins or (catches and not held[row])
            held[row] = catches
    return begins


@bare_kernel
def add_steps(
    moments: Array, basis: Array, elastic: Array, viscous: Array, step: int
) -> None:
    """Add up the tangents of all points in both steps of an interval."""
    for point in range(moments.shape[0]):
        rows = basis[3 * point : 3 * point + 3]
        mean, tilt = moments[point, 0], moments[point, 1]
        factor = _factor(mean[1], tilt[1])
        for part in range(2):
            sign = 2.0 * part - 1.0
            _add(elastic[step + part], rows, mean[0], tilt[0], 4.0 * sign)
            _add(viscous[step + part], rows, mean[1], tilt[1], factor * sign)


@inner_kernel
def _factor(mean: Array, tilt: Array) -> float:
    """Return the factor of the tilt: 4, or less where damping would be negative."""
    factor = 4.0
    for axis in range(3):
        size = abs(tilt[axis, axis])
        if mean[axis, axis] > 0.0 and size * factor > mean[axis, axis]:
            factor = mean[axis, axis] / size
    return factor


@inner_kernel
def _add(result: Array, rows: Array, mean: Array, tilt: Array, factor: float) -> None:
    """Add rowsᵀ (mean + factor tilt) rows."""
    for row in range(3):
        for column in range(3):
            size = mean[row, column] + factor * tilt[row, column]
            if size == 0.0:
                continue
            for i in range(rows.shape[1]):
                if rows[row, i] == 0.0:
                    continue
                for j in range(rows.shape[1]):
                    result[i, j] += size * rows[row, i] * rows[column, j]
