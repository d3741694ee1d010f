"""The direction in which a curve has come, to and fro along ripples (theory §6.2)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

from hbm.continuation.arc import distance, plane_across
from hbm.continuation.corrected import ITERATIONS
from hbm.continuation.correction import Correction, Outcome
from hbm.continuation.linearised import System
from hbm.continuation.newton import correct
from hbm.continuation.step_control import StepControl
from hbm.continuation.trail import ALIKE
from microslip_mechanics.arrays import Array


def onwards(
    system: System,
    way: Sequence[Correction],
    found: Array,
    scale: Array,
    control: StepControl,
) -> Array:
    """Return where a curve goes on from the last point of a way, shape (n + 1,).

    Few harmonics may lead it to and fro, which more do not: it may head back there, to
    where it has come from. So it does if it has begun ahead of where that point is
    ``found`` with more harmonics: what passed there on its way tells on which side.
    """
    along = way[-1].along
    normal = plane_across(along, scale)
    rise = float(normal @ along)

    def height(each: Correction) -> float:
        return float(normal @ (each.point - found)) / rise

    def is_there(each: Correction, little: float) -> bool:
        guess = each.point - height(each) * along
        passing = correct(
            system,
            guess,
            normal,
            tolerance=control.tolerance,
            max_iterations=ITERATIONS,
        )
        there = distance(passing.point, found, scale) <= little
        return there and passing.outcome is Outcome.CONVERGED

    passes = 0
    for before, after in itertools.pairwise(way[:-1]):
        ahead = height(after) > 0.0
        little = ALIKE * distance(before.point, after.point, scale)
        nearer = min(before, after, key=lambda each: abs(height(each)))
        if ahead is not (height(before) > 0.0) and is_there(nearer, little):
            passes += 1 if ahead else -1
    ends_ahead = len(way) > 1 and height(way[-2]) > 0.0
    return -along if passes and int(ends_ahead) > passes else along
