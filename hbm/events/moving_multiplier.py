"""Which multiplier is which at two neighbouring orbits (theory §6.4)."""

from __future__ import annotations

import numpy as np
from scipy.optimize import linear_sum_assignment

from microslip_mechanics.arrays import ComplexArray
from microslip_mechanics.results.response import MARGIN

ALIKE = 1e-9
"""relative distance of conjugates that rounding leaves"""


class MovingMultiplier:
    """The multiplier that crosses the unit circle somewhere between two orbits."""

    def __init__(self, which: int, before: ComplexArray, after: ComplexArray) -> None:
        """Follow the one that is ``which`` in the order of moduli while it is outside.

        ``before`` and ``after`` are all multipliers at the two.
        """
        self._which = which
        self._known = max(before, after, key=outside)
        self.outside: complex = self._known[which]
        """its last value outside"""
        self.alone = abs(outside(before) - outside(after)) == 1
        """whether no other crosses between the two"""
        self.ends = self.growth(before), self.growth(after)
        """its excess at the two"""

    def growth(self, multipliers: ComplexArray) -> float:
        """Return by how much its modulus exceeds one, at an orbit between.

        Inside the circle another may have taken its place in the order: there it is
        what it pairs with at the last orbit where it was outside.
        """
        ordered = excess(multipliers[self._which])
        if ordered > 0.0:
            self._known, self.outside = multipliers, multipliers[self._which]
            return ordered
        inside = [
            each
            for each in map(excess, partners(self._which, self._known, multipliers))
            if each < 0.0
        ]
        return max(inside, default=ordered)


def excess(multiplier: complex) -> float:
    """Return by how much the modulus of a multiplier exceeds one."""
    return float(abs(multiplier) - 1.0 - MARGIN)


def outside(multipliers: ComplexArray) -> int:
    """Return the number of multipliers outside the unit circle."""
    return int((np.abs(multipliers) > 1.0 + MARGIN).sum())


def partners(which: int, known: ComplexArray, others: ComplexArray) -> list[complex]:
    """Return what has become of a multiplier, and of its conjugate, at another orbit.

    All are paired so that the roots of the distances add up to the least: that leaves
    alone what hardly moves, such as one at +1, when another passes it.
    """
    one, two = (each.real + 1j * np.abs(each.imag) for each in (known, others))
    apart = np.sqrt(np.abs(one[:, None] - two))
    rows, columns = linear_sum_assignment(apart)
    alike = np.abs(one[rows] - one[which]) <= ALIKE * abs(one[which])
    return [complex(each) for each in others[columns[alike]]]
