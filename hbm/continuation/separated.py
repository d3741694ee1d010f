"""Factors of a bordered Jacobian by Schur's complement of what couples no orders."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from hbm.continuation.bordered import Bordered
from microslip_mechanics.arrays import Array


class Block(NamedTuple):
    """What couples within one order: [own across; back .], with the borders."""

    own: NDArray[np.int64]
    """its unknowns"""
    rest: NDArray[np.int64]
    """places among those left of the others of its order, the last one included"""
    across: Array
    """D⁻¹ [across slope], shape (own, rest)"""
    back: Array
    """[back; border], shape (rest, own)"""
    inverse: Array
    """D⁻¹"""


class Separated:
    """Factors of [Jacobian slope; border], by Schur's complement of such unknowns.

    A contact that is closed and sticks all the time is a spring: its motion couples no
    harmonics. Those that slip or part are left, whose factors cost the cube of fewer.
    """

    def __init__(
        self, blocks: list[Block], left: NDArray[np.int64], rest: Bordered
    ) -> None:
        """Take the blocks, the unknowns that are left, and the factors of these."""
        self._blocks, self._left, self._rest = blocks, left, rest
        signs = [np.linalg.slogdet(each.inverse)[0] for each in blocks]
        self.sign = rest.sign * float(np.prod(signs))

    def solve(self, right: Array) -> Array:
        """Return the solution, of shape ``(unknowns + 1,)`` or with several columns.

        Raises
        ------
        SingularError
            If there is none.
        """
        found = np.empty_like(right)
        reduced = right[self._left]
        inner = [each.inverse @ right[each.own] for each in self._blocks]
        for each, moved in zip(self._blocks, inner, strict=True):
            reduced[each.rest] -= each.back @ moved
        solved = self._rest.solve(reduced)
        found[self._left] = solved
        for each, moved in zip(self._blocks, inner, strict=True):
            found[each.own] = moved - each.across @ solved[each.rest]
        return found
