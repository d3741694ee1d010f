"""Stops that stiffen from nothing: how soft they begin, and what they lead to."""

import numpy as np
import pytest

from hbm.balance.relative_problem import relative_problem
from hbm.curves.stiffened import SOFT, soft, stiffening, stops
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from timedomain.shooting.comparison import compared

TURN = 2.0 * np.pi


def stopped(
    structure: float, damping: float, hertz: float, sides: int, law: UnilateralSpring
) -> Problem:
    """Return a mass with stops on one side or on both, driven by 1 N.

    ``structure`` is its stiffness [N/m], ``damping`` its ratio and ``hertz`` its
    natural frequency without stops.
    """
    mass = structure / (TURN * hertz) ** 2
    ends = (("x", "ground"), ("ground", "x"))[:sides]
    return system(
        names=["x"],
        mass=[mass],
        stiffness=[structure],
        damping=[2.0 * damping * np.sqrt(structure * mass)],
        elements=[Element(law, end, name=f"stop {end[0]}") for end in ends],
        drive={"x": 1.0},
    )


@pytest.mark.parametrize("sides", [1, 2])
@pytest.mark.parametrize("exponent", [1.0, 1.5])
@pytest.mark.parametrize(("structure", "stop"), [(1e3, 1e9), (1e6, 1e8), (1e4, 1e8)])
def test_stops_begin_soft_beside_what_resists_without_them(
    structure: float, stop: float, exponent: float, sides: int
) -> None:
    law = UnilateralSpring(stop, gap=1e-5, exponent=exponent)
    problem = stopped(structure, 0.01, 10.0, sides, law)
    relative = relative_problem(problem, static_equilibrium(problem))
    stiffer = stiffening(relative, TURN * 9.0, soft(relative))
    assert stiffer is not None

    softest = stiffer(relative, 0.0).points.stiffness
    whole = stiffer(relative, 1.0).points.stiffness

    resists = structure * abs(1.0 - 0.9**2 + 0.02j * 0.9)
    depth = 1.0 / resists  # of the motion without stops, under 1 N
    assert sum(softest * depth ** (exponent - 1.0)) == pytest.approx(SOFT * resists)
    np.testing.assert_array_equal(whole, stop)


def test_stops_that_resist_less_than_what_is_soft_are_whole() -> None:
    problem = stopped(1e6, 0.01, 10.0, 1, UnilateralSpring(1e3, gap=1e-5))
    relative = relative_problem(problem, static_equilibrium(problem))
    stiffer = stiffening(relative, TURN * 5.0, soft(relative))
    assert stiffer is not None
    assert stiffer(relative, 0.0).points.stiffness == pytest.approx(1e3)


def test_a_stop_that_only_another_moves_begins_soft_and_as_damped() -> None:
    # the second mass stays still without the stop through which the first one moves it
    structure, weak, hertz = 1e4, 10.0, 5.0
    law = HuntCrossleyContact(1e12, exponent=2.0, damping=1e4, damping_exponent=0.5)
    problem = system(
        names=["x", "y"],
        mass=[1.0, 0.01],
        stiffness=[structure, weak],
        damping=[1.0, 0.01],
        elements=[
            Element(law, ("x", "y"), name="first"),
            Element(law, ("y", "ground"), name="second"),
        ],
        drive={"x": 1.0},
    )
    relative = relative_problem(problem, static_equilibrium(problem))
    stiffer = stiffening(relative, TURN * hertz, stops(relative))
    assert stiffer is not None

    points = stiffer(relative, 0.0).points

    turn = TURN * hertz
    moves = 1.0 / (structure - turn**2 + 1j * turn)
    yields = 1.0 / (weak - 0.01 * turn**2 + 0.01j * turn)
    slopes = points.stiffness * abs(moves)  # of what each may be struck by
    resists = 1.0 / np.abs([moves + yields, yields])
    np.testing.assert_allclose(slopes, 0.5 * SOFT * resists, rtol=1e-6)
    np.testing.assert_allclose(points.damping**2 / points.stiffness, 1e8 / 1e12)


@pytest.mark.parametrize(
    ("structure", "damping", "hertz", "sides", "stop", "gap", "place"),
    [
        # a millionth of the stop is as stiff as the structure near its resonance
        pytest.param(1e3, 0.0105, 14.4, 2, 1e9, 1.8e-2, 14.7, id="soft beside it"),
        # 63 harmonics do not lead to the 255 that the impact asks for
        pytest.param(1.4e3, 0.0067, 11.6, 1, 3.9e7, 1.68e-3, 10.23, id="finer on"),
        pytest.param(1e4, 0.01, 10.0, 1, 1e8, 5e-5, 14.0, id="far above"),
    ],
)
def test_a_mass_between_far_stiffer_stops_has_a_first_point(
    structure: float,
    damping: float,
    hertz: float,
    sides: int,
    stop: float,
    gap: float,
    place: float,
) -> None:
    law = UnilateralSpring(stop, gap=gap)
    problem = stopped(structure, damping, hertz, sides, law)
    options = CurveOptions(TURN * place, TURN * 1.2 * place, events=False)

    first = next(frequency_response(problem, static_equilibrium(problem), options))

    assert first.frequency == TURN * place
    assert first.normal_largest[0] > 0.0
    assert compared(problem, first).agrees
