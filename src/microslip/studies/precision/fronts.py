"""What a method costs at an error that is asked for, and how fast it converges."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from microslip.studies.precision.precision import SURE, Run
from microslip_mechanics.arrays import TINY

LARGE = 0.1
"""error from which on nothing is said of convergence"""
WIDE = 1.5
"""cost of the dearest run over that of the cheapest, from which on there is a slope"""


def front(runs: Sequence[Run], quantity: int) -> list[Run]:
    """Return the complete runs that no cheaper one beats in error, by cost."""
    kept: list[Run] = []
    good = [run for run in runs if run.ending == "complete"]
    for run in sorted(good, key=lambda each: each.seconds):
        if not kept or run.errors[quantity] < kept[-1].errors[quantity]:
            kept.append(run)
    return kept


def cost_at(runs: Sequence[Run], quantity: int, asked: float, doubt: float) -> float:
    """Return the seconds for an error, interpolated along the front.

    NaN where it is not reached, infinite where the reference cannot tell: an error
    below ``SURE`` times its ``doubt`` may be the reference's own.
    """
    if asked < SURE * doubt:
        return math.inf
    best = front(runs, quantity)
    place = next((n for n, r in enumerate(best) if r.errors[quantity] <= asked), None)
    if place is None:
        return math.nan
    if place == 0:
        return best[0].seconds
    pair = best[place], best[place - 1]
    errors = np.log([max(run.errors[quantity], doubt, TINY) for run in pair])
    costs = np.log([run.seconds for run in pair])
    return float(np.exp(np.interp(math.log(asked), errors, costs)))


def slope(runs: Sequence[Run], quantity: int, doubt: float) -> float:
    """Return the exponent by which the error falls with cost, along the front.

    NaN where fewer than three runs are above the reference's doubt and below 10 %, or
    where they all cost about the same.
    """
    lowest = SURE * doubt
    seen = [
        run for run in front(runs, quantity) if lowest < run.errors[quantity] < LARGE
    ]
    if len(seen) < 3 or seen[-1].seconds < WIDE * seen[0].seconds:
        return math.nan
    costs = np.log([run.seconds for run in seen])
    errors = np.log([run.errors[quantity] for run in seen])
    return float(-np.polyfit(costs, errors, 1)[0])
