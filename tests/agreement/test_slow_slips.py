"""A slider that slips a little along two tangents, by harmonic balance and shooting."""

import numpy as np

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.polynomial_spring import PolynomialSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.shooting.comparison import compared

SPAN = (19.78, 19.9)
"""beyond the frequency at which the slider begins to slip [Hz]"""


def rubbed() -> Problem:
    """Return two ways of one point that rubs, one of them on a spring that bends.

    How far that is bent goes with the mean of the traction.
    """
    slider = ElasticFriction(stiffness=5e3, mu=0.5, load=20.0)
    bends = PolynomialSpring(coefficients={2.0: 0.25e4 / 1.5e-3})
    return system(
        names=["a", "b"],
        mass=[1.0, 1.0],
        stiffness=[1e4, 1.1e4],
        damping_ratio=0.01,
        drive={"a": 1.0, "b": (1.0, 1.2)},
        elements=[
            Element(slider, tangents=[("a", "ground"), ("b", "ground")]),
            Element(bends, ("a", "ground")),
        ],
    )


def test_a_slider_that_forgets_slowly_has_the_mean_with_which_its_loop_closes() -> None:
    # a period leaves up to 0.98 of the traction before
    problem = rubbed()
    start, end = (2.0 * np.pi * each for each in SPAN)
    options = CurveOptions(start, end, stability=False)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    slips = [each for each in found if each.friction_energy > 0.0 and not each.event]
    shot = [compared(problem, each) for each in slips[:: max(len(slips) // 4, 1)]]
    assert len(shot) >= 4
    assert [each.as_estimated for each in shot] == [True] * len(shot)
    assert max(each.difference for each in shot) < 1e-3
