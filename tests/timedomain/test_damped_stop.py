"""Shooting of a mass that a stop with a dashpot throws back: its steps leap."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.shooting.comparison import compared


@pytest.mark.long
def test_orbits_are_found_where_the_force_jumps_as_faces_touch() -> None:
    stop = UnilateralSpring(stiffness=5e3, gap=1e-3, damping=2.0)
    problem = system(
        mass=[2.0 / 3.0],
        stiffness=[1e3],
        damping=[1.0],
        elements=[Element(stop, between=("x1", "ground"))],
        drive={"x1": 2.0 / 3.0},
    )
    start, end = 2.0 * np.pi * 7.84, 2.0 * np.pi * 7.9
    rest = static_equilibrium(problem)
    points = frequency_response(problem, rest, CurveOptions(start, end))

    # those that no change of the first state brings to close within rounding too
    found = [compared(problem, each) for each in points if not each.event]

    assert len(found) > 5
    assert all(each.agrees for each in found)
    assert np.mean([each.as_estimated for each in found]) > 0.95
