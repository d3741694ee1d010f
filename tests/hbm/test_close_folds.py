"""Folds close to each other, and branch points that are nothing but a fold."""

import numpy as np
import pytest

from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.hunt_crossley import HuntCrossleyContact
from microslip_mechanics.laws.polynomial_spring import CubicSpring, PolynomialSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from random_systems import random_system

TURN = 2.0 * np.pi


def events(
    problem: Problem, lowest: float, highest: float, error: float
) -> list[tuple[str, float]]:
    """Return what is located on a curve, and its frequency [Hz]."""
    options = CurveOptions(TURN * lowest, TURN * highest, error=error)
    curve = frequency_response(problem, static_equilibrium(problem), options)
    return [(each.event, each.frequency / TURN) for each in curve if each.event]


def pressed_duffing() -> Problem:
    return system(
        mass=[1.3],
        stiffness=[40.0],
        damping=[0.1],
        elements=[Element(CubicSpring(cubic=900.0), between=("x1", "ground"))],
        preload={"x1": 2.0},
        drive={"x1": (0.8, 0.7)},
    )


def spring_and_sphere() -> Problem:
    """Return a mass whose upper fold lies where a contact barely closes at a sample."""
    return system(
        mass=[0.842],
        stiffness=[103.04],
        damping_ratio=0.03936,
        elements=[
            Element(
                PolynomialSpring(coefficients={1: 12.48, 3: 4.4935}),
                between=("x1", "ground"),
            ),
            Element(
                HuntCrossleyContact(stiffness=146.653, exponent=1.5),
                between=("x1", "ground"),
            ),
        ],
        drive={"x1": 34.4285},
    )


def spring_and_stop() -> Problem:
    return system(
        names=["a", "b"],
        mass=[1.0, 0.6],
        stiffness=[[900.0, -400.0], [-400.0, 500.0]],
        damping=[[0.9, -0.4], [-0.4, 0.5]],
        elements=[
            Element(CubicSpring(cubic=2e5), between=("b", "ground")),
            Element(
                UnilateralSpring(stiffness=600.0, gap=5e-3), between=("a", "ground")
            ),
        ],
        preload={"b": 1.0},
        drive={"a": 0.5, "b": (0.3, np.pi / 2.0)},
    )


def two_stops() -> Problem:
    return system(
        names=["a", "b"],
        mass=[1.0, 0.5],
        stiffness=[[500.0, -200.0], [-200.0, 200.0]],
        damping=[[1.5, -0.6], [-0.6, 0.6]],
        elements=[
            Element(
                UnilateralSpring(stiffness=800.0, gap=0.01, damping=2.0),
                between=("b", "ground"),
            ),
            Element(
                UnilateralSpring(stiffness=3e4, gap=4e-3, exponent=1.5),
                between=("ground", "a"),
            ),
        ],
        preload={"b": -0.6},
        drive={"a": 0.5},
    )


@pytest.mark.parametrize(
    ("problem", "lowest", "highest"),
    [
        pytest.param(pressed_duffing(), 0.3, 2.5, id="pressed Duffing"),
        pytest.param(spring_and_stop(), 2.0, 8.0, id="spring and stop"),
    ],
)
def test_a_fold_of_few_harmonics_makes_no_branch_point(
    problem: Problem, lowest: float, highest: float
) -> None:
    found = events(problem, lowest, highest, 1e-2)

    names = {name for name, _ in found}
    assert "fold" in names
    assert "branch point" not in names


def test_two_folds_within_a_step_are_both_found() -> None:
    found = events(two_stops(), 1.0, 6.0, 3e-4)

    folds = [hertz for name, hertz in found if name == "fold" and 2.25 < hertz < 2.28]
    # of an arc-length continuation by shooting
    assert folds == pytest.approx([2.276076, 2.27517, 2.275767, 2.25892], abs=4e-4)


@pytest.mark.parametrize(
    # 8e-4 Hz are told
    ("error", "aside"),
    [(3e-3, 8e-4), (1e-3, 1e-4), (1e-4, 1e-4)],
)
def test_a_fold_at_a_small_jump_of_the_residual_is_told(
    error: float, aside: float
) -> None:
    found = events(spring_and_sphere(), 2.3, 2.8, error)

    folds = [place for name, place in found if name == "fold"]
    # by marches, stepped up and down; upwards the motion jumps before 2.58292 Hz
    assert folds == pytest.approx([2.5828, 2.4302], abs=aside)


@pytest.mark.parametrize("highest", [0.32, 0.45])
def test_a_pair_that_meets_before_a_fold_is_no_torus(highest: float) -> None:
    """Of a pair outside the circle one goes through +1 in the fold at 0.2063 Hz.

    Checked by integrating the variational equations of both orbits beside it.
    """
    absorber = system(
        names=["h", "a"],
        mass=[1.0, 0.05],
        stiffness=[[1.0454, -0.0454], [-0.0454, 0.0454]],
        damping=[[0.0148, -0.0128], [-0.0128, 0.0128]],
        elements=[
            Element(CubicSpring(cubic=1.0), between=("h", "ground")),
            Element(CubicSpring(cubic=0.0042), between=("h", "a")),
        ],
        drive={"h": 0.15},
    )
    found = events(absorber, 0.11, highest, 1e-3)
    tori = [where for name, where in found if name == "Neimark-Sacker"]
    assert tori == pytest.approx([0.178710], rel=1e-4)
    folds = [where for name, where in found if name == "fold"]
    assert folds == pytest.approx([0.177050, 0.175204, 0.206298, 0.198500], rel=1e-5)


def test_a_fold_that_is_nearer_to_another_than_half_a_step_is_told() -> None:
    problem = random_system(4)
    options = CurveOptions(5.0, 60.0, harmonics=7, errors=False, stability=False)

    curve = list(frequency_response(problem, static_equilibrium(problem), options))

    told = [each.parameter for each in curve if each.event == "fold"]
    ways = np.diff(told)
    assert len(told) == 6
    # to the right and to the left in turn
    assert (ways[1:] * ways[:-1] < 0.0).all()
    assert np.abs(ways).min() < 0.05
