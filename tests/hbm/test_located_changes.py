"""Changes of stability between which few harmonics have other multipliers."""

import math

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.static import static_equilibrium
from small_problems import between_stops

HERTZ = 2.0 * math.pi


@pytest.mark.parametrize(("lowest", "highest"), [(1.64, 1.70), (2.25, 2.30)])
def test_a_mass_between_stops_has_a_branch_point_where_its_stability_changes(
    lowest: float, highest: float
) -> None:
    # Two multipliers meet on the real axis a hair's breadth from there: those of orbits
    # with half the harmonics do so at another frequency.
    problem = between_stops()
    rest = static_equilibrium(problem)
    options = CurveOptions(lowest * HERTZ, highest * HERTZ)

    curve = list(frequency_response(problem, rest, options))
    (told,) = (each for each in curve if each.event)
    others = [each for each in curve if each is not told]
    below, above = (
        {each.unstable for each in others if (each.frequency > told.frequency) is side}
        for side in (False, True)
    )

    assert told.event == "branch point"
    assert np.abs(told.multipliers - 1.0).min() < 1e-3
    assert sorted([*below, *above]) == [0, 1]
