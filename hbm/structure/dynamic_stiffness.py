"""The dynamic stiffness of a condensed structure, order by order (theory §6.1)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array, ComplexArray
from microslip_mechanics.jit import inner_kernel, kernel


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
) -> ComplexArray:
    """Return S(s) of the coordinates wanted, (orders, rank, rank) (theory, eq. 15).

    Arguments are those of a
    :class:`~hbm.structure.condensed_structure.CondensedStructure`, couplings by rows of
    y, shape (rank, poles); ``variable`` is s, ``wanted`` (orders, rank).
    """
    orders, (rank, count) = variable.size, viscous.shape
    value = np.zeros((orders, rank, rank), np.complex128)
    pole = np.empty(count, np.complex128)
    into, back = np.empty((2, rank, count), np.complex128)
    for order in range(orders):
        s, moves = variable[order], np.flatnonzero(wanted[order])
        for p in range(count):
            pole[p] = s * s * _inverse(s - poles[p])
        for a in moves:
            for p in range(count):
                into[a, p] = (viscous[a, p] + s * inertial[a, p]) * pole[p]
                back[a, p] = viscous_back[a, p] + s * inertial_back[a, p]
        for place, b in enumerate(moves):
            for a in moves if gyroscopic else moves[: place + 1]:
                total = _sum(back, a, into, b)
                total = stiffness[a, b] + s * (damping[a, b] + s * mass[a, b]) - total
                value[order, a, b] = total
                if not gyroscopic:
                    value[order, b, a] = total
    return value


@kernel
def stiffness_slope(
    damping: Array,
    mass: Array,
    poles: ComplexArray,
    viscous: ComplexArray,
    inertial: ComplexArray,
    viscous_back: ComplexArray,
    inertial_back: ComplexArray,
    variable: ComplexArray,
    relative: ComplexArray,
) -> ComplexArray:
    """Return (dS/ds) y of each order, shape ``(orders, rank)``.

    With S = K + s C + s² M − B D G, where D = 1/(s − λ), and G = s (V + s I) and B
    likewise are the couplings into the poles and back.
    """
    orders, (rank, count) = variable.size, viscous.shape
    slope = np.zeros((orders, rank), np.complex128)
    turned = np.empty((2, count), np.complex128)
    for order in range(orders):
        s, y = variable[order], relative[order]
        moves = np.flatnonzero(y)
        if moves.size == 0:
            continue
        turned[:] = 0.0
        for b in moves:
            for p in range(count):
                turned[0, p] += viscous[b, p] * y[b]
                turned[1, p] += inertial[b, p] * y[b]
        for p in range(count):
            slow, fast = turned[0, p], s * turned[1, p]
            pole = _inverse(s - poles[p])
            into = s * (slow + fast) * pole
            turn = s * (slow + 2.0 * fast - into) * pole
            turned[0, p] = into + turn
            turned[1, p] = s * (2.0 * into + turn)
        for a in range(rank):
            total = -_sum(viscous_back, a, turned, 0) - _sum(
                inertial_back, a, turned, 1
            )
            for b in moves:
                total += (damping[a, b] + 2.0 * s * mass[a, b]) * y[b]
            slope[order, a] = total
    return slope


@kernel
def returned_load(
    poles: ComplexArray,
    viscous_back: ComplexArray,
    inertial_back: ComplexArray,
    variable: ComplexArray,
    modal: ComplexArray,
) -> tuple[ComplexArray, ComplexArray]:
    """Return −B D f and its derivative by s, where ``modal`` is f: (orders, poles).

    With B and D as above; what the poles hand on, shape ``(orders, rank)``.
    """
    orders, (rank, count) = variable.size, viscous_back.shape
    load = np.zeros((orders, rank), np.complex128)
    change = np.zeros((orders, rank), np.complex128)
    once, turned = np.empty((2, 2, count), np.complex128)
    for order in range(orders):
        s = variable[order]
        for p in range(count):
            pole = _inverse(s - poles[p])
            moved = modal[order, p] * pole
            once[0, p], once[1, p] = -s * moved, -s * s * moved
            turned[0, p] = -moved * (1.0 - s * pole)
            turned[1, p] = -s * moved * (2.0 - s * pole)
        for a in range(rank):
            load[order, a] = _sum(viscous_back, a, once, 0)
            load[order, a] += _sum(inertial_back, a, once, 1)
            change[order, a] = _sum(viscous_back, a, turned, 0)
            change[order, a] += _sum(inertial_back, a, turned, 1)
    return load, change


@inner_kernel
def _sum(
    first: ComplexArray, row: np.int_ | int, second: ComplexArray, other: np.int_ | int
) -> complex:
    """Return the sum of products of two rows."""
    total = 0.0j
    for p in range(first.shape[1]):
        total += first[row, p] * second[other, p]
    return total


@inner_kernel
def _inverse(value: complex) -> complex:
    """Return 1/value by one division: numba's guards against overflow with branches."""
    share = 1.0 / (value.real**2 + value.imag**2)
    return complex(value.real * share, -value.imag * share)
