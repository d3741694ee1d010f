"""The dynamic stiffness of a condensed structure, order by order (theory §6)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import kernel


@kernel
def dynamic_stiffness(
    stiffness: Array,
    damping: Array,
    mass: Array,
    poles: ComplexArray,
    viscous: ComplexArray,
    inertial: ComplexArray,
    viscous_back: ComplexArray,
    inertial_back: ComplexArray,
    variable: ComplexArray,
    wanted: NDArray[np.bool_],
    gyroscopic: bool,
) -> tuple[ComplexArray, ComplexArray]:
    """Return S(s) and dS/ds of the coordinates wanted (theory, eqs. 15–16)."""
    orders, (rank, count) = variable.size, viscous.shape
    value = np.zeros((orders, rank, rank), np.complex128)
    change = np.zeros((orders, rank, rank), np.complex128)
    into, turn = np.empty(count, np.complex128), np.empty(count, np.complex128)
    for order in range(orders):
        s = variable[order]
        pole = 1.0 / (s - poles)
        for b in range(rank):
            if not wanted[order, b]:
                continue
            for p in range(count):
                slow, fast = viscous[b, p], inertial[b, p]
                into[p] = (slow + s * fast) * s * pole[p]
                turn[p] = (slow + 2.0 * s * fast) * pole[p] - into[p] * pole[p]
            for a in range(rank if gyroscopic else b + 1):
                if not wanted[order, a]:
                    continue
                total, slope = 0.0j, 0.0j
                for p in range(count):
                    slow, fast = viscous_back[a, p], inertial_back[a, p]
                    total += (slow + s * fast) * into[p]
                    slope += (slow + 2.0 * s * fast) * into[p]
                    slope += s * (slow + s * fast) * turn[p]
                total = (
                    stiffness[a, b] + s * (damping[a, b] + s * mass[a, b]) - (s * total)
                )
                slope = damping[a, b] + 2.0 * s * mass[a, b] - slope
                _enter(value[order], a, b, total, gyroscopic)
                _enter(change[order], a, b, slope, gyroscopic)
    return value, change


@kernel
def _enter(
    matrix: ComplexArray, row: int, column: int, value: complex, gyroscopic: bool
) -> None:
    """Write an entry; and its mirror image unless that is an entry of its own."""
    matrix[row, column] = value
    if not gyroscopic:
        matrix[column, row] = value
