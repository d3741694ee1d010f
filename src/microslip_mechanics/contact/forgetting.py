"""What a period leaves of a traction, and what further periods change (theory §6.5).

A slider that slips along two tangents, a little at each end of its way, forgets slowly,
as bristles do that slip little.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.jit import bare_kernel, inner_kernel

STEADY = 1e-12
"""share of a traction that is nothing"""
FAINT = 1e-7
"""share of their traction that is forgotten in a period, below which points stick"""
EVEN = 0.1
"""of a period's change, up to which it may differ from what is kept of the one before:
then what follows is known"""


@bare_kernel
def keep(by: Array, axes: NDArray[np.bool_], kept: Array) -> None:
    """Multiply what is kept so far by what a slide keeps, by its derivatives."""
    for column in range(2):
        one, two = kept[0, column], kept[1, column]
        if axes[1]:
            kept[0, column] = by[0, 6] * one + by[0, 7] * two
        if axes[2]:
            kept[1, column] = by[1, 6] * one + by[1, 7] * two


@bare_kernel
def even(kept: Array, past: Array, moved: Array) -> bool:
    """Return whether a period changed the traction by what it kept of the last change.

    That one is infinite where it tells nothing.
    """
    if math.isinf(past[0]):
        return False
    one, two = _times(kept, past)
    missed = max(abs(moved[0] - one), abs(moved[1] - two))
    return bool(missed <= EVEN * max(abs(moved[0]), abs(moved[1])))


@bare_kernel
def further(kept: Array, known: bool, more: Array) -> bool:
    """Write what all further periods change, by what the last one has changed.

    That is K + K² + …, if a period keeps K: nothing where that is not ``known``, where
    nothing is kept, or all along some direction, as what sticks does. Return whether it
    is more than that.
    """
    more[:] = 0.0
    one, two = 1.0 - kept[0, 0], 1.0 - kept[1, 1]
    forgets = one * two - kept[0, 1] * kept[1, 0]
    most = max(abs(kept[0, 0]), abs(kept[0, 1]), abs(kept[1, 0]), abs(kept[1, 1]))
    if not known or most <= STEADY or forgets <= FAINT * (one + two):
        return False
    more[0, 0], more[1, 1] = two / forgets - 1.0, one / forgets - 1.0
    more[0, 1], more[1, 0] = kept[0, 1] / forgets, kept[1, 0] / forgets
    return True


@bare_kernel
def go_on(more: Array, goes_on: bool, moved: Array, state: Array, past: Array) -> None:
    """Add to the traction and its change, (2, 2), what further periods do.

    ``moved`` is what the last one has changed of them; ``past`` is written with that
    of the traction, or infinity where the traction has leaped.
    """
    for axis in range(2):
        past[axis] = math.inf if goes_on else moved[0, axis]
    for each in range(2):
        one, two = _times(more, moved[each])
        state[each, 0] += one
        state[each, 1] += two


@inner_kernel
def _times(matrix: Array, vector: Array) -> tuple[float, float]:
    """Return a product, of shapes (2, 2) and (2,)."""
    one = matrix[0, 0] * vector[0] + matrix[0, 1] * vector[1]
    two = matrix[1, 0] * vector[0] + matrix[1, 1] * vector[1]
    return one, two
