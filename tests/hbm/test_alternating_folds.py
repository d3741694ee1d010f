"""Along a curve, folds to the right and to the left alternate."""

import itertools

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from random_systems import random_system


# a closed curve passes close by that of 0; others have gaps
@pytest.mark.parametrize("seed", [0, 1, 2, 4, 6, 8])
def test_folds_to_the_right_and_to_the_left_alternate(seed: int) -> None:
    problem = random_system(seed)
    options = CurveOptions(5.0, 60.0, harmonics=7, errors=False, stability=False)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    told = [each.parameter for each in curve if each.event == "fold"]
    ways = np.diff(told)
    assert len(told) >= 2
    assert len(told) % 2 == 0
    assert (ways[1:] * ways[:-1] < 0.0).all()
    assert unmatched(curve) == []


def unmatched(curve: list[PeriodicResponse]) -> list[float]:
    """Return where the frequency turns between points without a fold there.

    Two folds between three points leave no turn behind; a fold alone must.
    """
    points = [n for n, each in enumerate(curve) if not each.event]
    steps = list(itertools.pairwise(points))
    told = [sum(each.event == "fold" for each in curve[i:j]) for i, j in steps]
    ways = [curve[j].parameter - curve[i].parameter for i, j in steps]
    missed = []
    for n in range(1, len(ways)):
        if ways[n - 1] * ways[n] < 0.0:
            beside = max(n - 1, n, key=lambda each: told[each] % 2)
            told[beside] -= 1
            if told[beside] < 0:
                missed.append(curve[points[n]].parameter)
    for n, left in enumerate(told[:-1]):
        if left % 2 and told[n + 1] % 2:
            told[n], told[n + 1] = left - 1, told[n + 1] - 1
    alone = [curve[points[n]].parameter for n, left in enumerate(told) if left % 2]
    return missed + alone
