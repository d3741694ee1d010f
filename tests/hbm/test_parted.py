"""A first point where a drive parts what is pressed together, and something rubs."""

from dataclasses import replace

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.contact.points import COULOMB
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from timedomain.shooting.comparison import compared
from timedomain.shooting.shooting import ShootingOptions

TURN = 2.0 * np.pi


def rubbing(problem: Problem) -> Problem:
    """Return a problem with friction at its contacts, which slide nowhere in it."""
    points = problem.interface.points
    one = np.ones_like(points.gap)
    points = points._replace(
        friction=np.full(one.size, COULOMB), dynamic=0.3 * one, static=0.3 * one
    )
    return replace(problem, interface=replace(problem.interface, points=points))


@pytest.mark.parametrize(
    ("mass", "stiffness", "damping", "drive", "stop", "preload", "hertz"),
    [
        (1.0, 1e4, 4.0, 4.0, 3e5, 31.0, 4.77),
        pytest.param(
            1.4, 2.54e6, 249.0, 1560.0, 4.88e7, 2665.0, 125.7, marks=pytest.mark.slow
        ),
    ],
)
def test_a_mass_that_is_lifted_off_what_may_rub_has_a_first_point(
    mass: float,
    stiffness: float,
    damping: float,
    drive: float,
    stop: float,
    preload: float,
    hertz: float,
) -> None:
    problem = rubbing(
        system(
            mass=[mass],
            stiffness=[stiffness],
            damping=[damping],
            elements=[
                Element(UnilateralSpring(stop, preload=preload), ("x1", "ground"))
            ],
            drive={"x1": drive},
        )
    )
    options = CurveOptions(TURN * hertz, TURN * 2.0 * hertz, events=False)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    found = compared(problem, first, ShootingOptions(error=1e-4))
    assert first.frequency == TURN * hertz
    assert first.normal_smallest[0] == 0.0
    assert found.agrees
    assert found.as_stable


@pytest.mark.long
def test_an_element_that_rattles_without_friction_has_a_first_point() -> None:
    """The full rig, whose element a hundred times the preload drives off its faces."""
    problem = rig_problem(
        model="full",
        friction__mu_dynamic=0.0,
        friction__mu_static=0.0,
        preload__force=0.01,
        excitation__force=1.0,
    )
    options = CurveOptions(TURN * 125.0, TURN * 145.0, events=False)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    assert first.frequency == TURN * 125.0
    assert first.error < options.error
    assert (first.normal_smallest <= 0.0).all()  # each corner parts
    assert compared(problem, first).agrees
