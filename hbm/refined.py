"""Two Newton steps at a finer resolution, and what they leave to do (theory §6)."""

from __future__ import annotations

import math
from typing import NamedTuple, Protocol

import numpy as np

from hbm.newton import CHORD, Linearised
from microslip_mechanics.arrays import Array

SURE = 0.25
"""share of a residual that a Newton step leaves, after which the next leaves less"""
DEPARTS = 2.0
"""times that a residual grows in two steps that lead to no point"""
FEW = 16
"""harmonics below which a series may not have begun to fall as it will"""
WARY, SAFE = 9.0, 4.5
"""factors of the impulses beyond: with few harmonics, and with more"""
MOST = 2.0
"""what all harmonics beyond change at the most, over what the last octave did"""


class Resolved(Protocol):
    """A system at one resolution."""

    def __call__(self, point: Array) -> tuple[Array, Linearised]:
        """Return the residual, and what solves with its Jacobian."""

    def residual(self, point: Array) -> tuple[Array, object]:
        """Return the residual, and what belongs to it."""

    def impulses(self, above: int, most: int) -> float:
        """Return the norm of the contact impulses between two orders, last call."""


class Refined(NamedTuple):
    """A point after two Newton steps, and what they leave."""

    residual: Array
    """of the finer resolution before them"""
    after: Array
    """the point after the first"""
    corrected: Array
    """and after both"""
    left: float
    """what further steps would change, over what the second did"""
    beyond: float
    """what still more harmonics would change, over what both did"""


def refined(system: Resolved, point: Array, harmonics: int, normal: Array) -> Refined:
    """Return a point after two Newton steps in the plane normal to ``normal``.

    ``harmonics`` are those of ``system``, about twice those of the point. The second
    step has factors of its own if the first leaves much.

    Raises
    ------
    SingularError
        If the point lies on a fold.
    """
    residual, first = system(point)
    known = system.impulses(harmonics // 2, harmonics)
    after = point + first.solve(normal, np.append(-residual, 0.0))
    again, second = system(after)
    before, between = float(np.linalg.norm(residual)), float(np.linalg.norm(again))
    factors = first if between <= CHORD * before else second
    corrected = after + factors.solve(normal, np.append(-again, 0.0))
    last, _ = system.residual(corrected)
    share = system.impulses(harmonics, 2 * harmonics + 1) / known if known else 0.0
    left = _left(before, between, float(np.linalg.norm(last)))
    return Refined(residual, after, corrected, left, _beyond(share, harmonics))


def _left(before: float, between: float, after: float) -> float:
    """Return what steps to come change, over the second of two, from the residuals.

    Infinite where they lead away.
    """
    if after <= SURE * between:
        return after / (between - after) if between > 0.0 else 0.0
    return math.inf if after > DEPARTS * before else 1.0


def _beyond(share: float, harmonics: int) -> float:
    """Return what still more harmonics change, over what the last octave did.

    ``share`` is that of the contact impulses beyond, over those of the octave. Motions
    of high order answer these impulses, and act on the low orders through tangents that
    fall alike: what they change is like the square.
    """
    if harmonics < FEW:
        return (WARY * share) ** 2
    return min(MOST, (SAFE * share) ** 2)
