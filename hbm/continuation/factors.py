"""What solves with a bordered Jacobian, as its unknowns couple (theory §6.1)."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hbm.continuation.bordered import Bordered
from hbm.continuation.separated import Block, Separated
from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.jit import kernel

FEWEST = 400
"""unknowns from which on it is looked for"""
WORTH = 0.8
"""of all unknowns: so many may be left at most"""
COUPLED = 1e-12
"""of the own entries of two unknowns: coupling between orders that is no rounding"""
SOUND = 1e-9
"""least singular value of a block over its largest"""
Factors: TypeAlias = Bordered | Separated


def factored(
    jacobian: Array,
    slope: Array,
    border: Array,
    orders: NDArray[np.int64] | None,
    coordinates: NDArray[np.int64] | None,
) -> Factors:
    """Return what solves with a bordered Jacobian.

    Parameters
    ----------
    jacobian, slope, border
        As :class:`~hbm.continuation.bordered.Bordered` takes them.
    orders, coordinates
        Of each unknown, shape ``(unknowns,)``; None if there is no such thing.

    Raises
    ------
    SingularError
        If it has no inverse.
    """
    if orders is not None and coordinates is not None and slope.size >= FEWEST:
        apart = _apart(jacobian, orders, coordinates)
        if np.count_nonzero(~apart) <= WORTH * slope.size:
            made = _separated(jacobian, slope, border, orders, apart)
            if made is not None:
                return made
    return Bordered(jacobian, slope, border)


def _apart(
    jacobian: Array, orders: NDArray[np.int64], coordinates: NDArray[np.int64]
) -> NDArray[np.bool_]:
    """Return which unknowns are of coordinates that couple no orders, (unknowns,)."""
    scale = np.sqrt(np.maximum(np.abs(jacobian.diagonal()), TINY))
    coupled = np.zeros(int(coordinates.max()) + 1, dtype=np.bool_)
    _couple(np.ascontiguousarray(jacobian), scale, orders, coordinates, coupled)
    found: NDArray[np.bool_] = ~coupled[coordinates]
    return found


@kernel
def _couple(
    jacobian: Array,
    scale: Array,
    orders: NDArray[np.int64],
    coordinates: NDArray[np.int64],
    coupled: NDArray[np.bool_],
) -> None:
    """Write which coordinates couple orders, until all are known to do so."""
    for row in range(orders.size):
        a = coordinates[row]
        for column in range(orders.size):
            b = coordinates[column]
            if (coupled[a] and coupled[b]) or orders[row] == orders[column]:
                continue
            if abs(jacobian[row, column]) > COUPLED * scale[row] * scale[column]:
                coupled[a] = coupled[b] = True
        if coupled.all():
            return


def _separated(
    jacobian: Array,
    slope: Array,
    border: Array,
    orders: NDArray[np.int64],
    apart: NDArray[np.bool_],
) -> Separated | None:
    """Return the factors; None if a block is nearly singular by itself."""
    count = slope.size
    kept = np.flatnonzero(~apart)
    left = np.append(kept, count)
    matrix = np.empty((left.size, left.size))
    matrix[:-1, :-1] = jacobian[np.ix_(kept, kept)]
    matrix[:-1, -1], matrix[-1] = slope[kept], border[left]
    blocks = []
    for order in np.unique(orders[apart]):
        own = np.flatnonzero(apart & (orders == order))
        rest = np.flatnonzero(orders[kept] == order)
        inner = jacobian[np.ix_(own, own)]
        if np.linalg.cond(inner) * SOUND > 1.0:
            return None
        inverse = np.linalg.inv(inner)
        across = np.column_stack([jacobian[np.ix_(own, kept[rest])], slope[own]])
        back = np.vstack([jacobian[np.ix_(kept[rest], own)], border[own]])
        rest = np.append(rest, kept.size)
        solved = inverse @ across
        matrix[np.ix_(rest, rest)] -= back @ solved
        blocks.append(Block(own, rest, solved, back, inverse))
    return Separated(
        blocks, left, Bordered(matrix[:-1, :-1], matrix[:-1, -1], matrix[-1])
    )
