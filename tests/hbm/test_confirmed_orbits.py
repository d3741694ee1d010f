"""Where friction falls with the speed, orbits of few harmonics must be confirmed."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from timedomain.comparison import compared

HERTZ = 2.0 * np.pi


@pytest.mark.parametrize("frequency", [145.0, 143.0])
def test_no_orbit_is_farther_away_than_its_error_admits(frequency: float) -> None:
    # friction falls to a half within what the element's speed changes in a sample
    problem = rig_problem(
        model="B",
        friction__law="gkf",
        friction__mu_dynamic=0.1,
        friction__mu_static=0.2,
        friction__stribeck_velocity=1e-3,
    )
    options = CurveOptions(HERTZ * frequency, HERTZ * 150.0, error=5e-3)

    first = next(frequency_response(problem, static_equilibrium(problem), options))
    found = compared(problem, first)

    assert found.agrees
