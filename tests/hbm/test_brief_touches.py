"""Multipliers of motions that touch a stop briefly, against exact pieces."""

from itertools import pairwise

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.optimize import brentq

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.element import Element
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system

TURN = 2.0 * np.pi
SPRING, DAMPING, GAP = 1e3, 1.9, 5e-4


def struck(stop: float, *, both: bool, slider: bool, gap: float = GAP) -> Problem:
    """Return a mass of 1 kg at a stop, or between two that are alike.

    Beside it may be another on a slider, which makes the contacts remember.
    """
    elements = [Element(UnilateralSpring(stop, gap), between=("x", "ground"))]
    if both:
        elements.append(Element(UnilateralSpring(stop, gap), between=("ground", "x")))
    if slider:
        elements.append(Element(Jenkins(300.0, 0.5), between=("s", "ground")))
    names = ["x", "s"] if slider else ["x"]
    return system(
        names=names,
        mass=[1.0] * len(names),
        stiffness=np.diag([SPRING] * len(names)),
        rayleigh_damping=(DAMPING, 0.0),
        elements=elements,
        drive=dict(zip(names, (0.1, 2.0), strict=False)),
    )


def by_pieces(response: PeriodicResponse, stop: float, *, both: bool) -> Array:
    """Return the product of what carries a small motion between touches, (2, 2).

    Half a period does between two stops that are alike.
    """
    phase = np.linspace(0.0, TURN, 2001)
    period = TURN / response.frequency

    def depth(each: float) -> float:
        moved = response.at(np.array([each]))[0][0, 0]
        return float(abs(moved) if both else moved) - GAP

    depths = np.array([depth(each) for each in phase])
    place = np.flatnonzero((depths[:-1] > 0.0) != (depths[1:] > 0.0))
    edges = [brentq(depth, phase[each], phase[each + 1], xtol=1e-13) for each in place]
    edges = [0.0, *edges, TURN]
    whole = np.eye(2)
    for begin, end in pairwise(edges):
        held = stop if depth(0.5 * (begin + end)) > 0.0 else 0.0
        rates = np.array([[0.0, 1.0], [-(SPRING + held), -DAMPING]])
        whole = expm(rates * (end - begin) / TURN * period) @ whole
    return whole


@pytest.mark.parametrize("slider", [False, True])
@pytest.mark.parametrize("both", [False, True])
@pytest.mark.parametrize("stop", [1e5, 1e6])
def test_what_touches_briefly_leaves_as_it_vibrates_on_its_contact(
    stop: float, both: bool, slider: bool
) -> None:
    problem = struck(stop, both=both, slider=slider)
    ends = (4.3, 4.9)
    options = CurveOptions(
        TURN * ends[0],
        TURN * ends[1],
        harmonics=31,
        samples=1024,
        errors=False,
        events=False,
    )
    *_, response = frequency_response(problem, static_equilibrium(problem), options)
    assert response.normal_largest.max() > 0.0

    expected = np.linalg.eigvals(by_pieces(response, stop, both=both))

    away = np.abs(response.multipliers[:, None] - expected).min(axis=0)
    # with sliders the contacts are carried by steps of second order
    assert away.max() < (1e-3 if slider else 1e-4)


def test_a_mass_that_always_touches_one_of_two_stops_is_on_a_spring() -> None:
    # a touch lasts half a period: no time is left for mean tangents without one
    stop, turn = 500.0, TURN * 4.3
    problem = struck(stop, both=True, slider=True, gap=0.0)
    options = CurveOptions(
        turn, 1.001 * turn, harmonics=7, samples=512, errors=False, events=False
    )
    response = next(frequency_response(problem, static_equilibrium(problem), options))

    rates = np.array([[0.0, 1.0], [-(SPRING + stop), -DAMPING]])
    expected = np.exp(np.linalg.eigvals(rates) * TURN / turn)

    away = np.abs(response.multipliers[:, None] - expected).min(axis=0)
    assert away.max() < 1e-3
