"""Along a curve, folds to the right and to the left alternate."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
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
