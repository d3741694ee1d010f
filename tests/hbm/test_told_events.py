"""Events that a curve passes again are told once."""

from collections import Counter
from dataclasses import replace

import numpy as np
import pytest

from hbm.events.told_events import ToldEvents
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.element import Element
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.results.response import PeriodicResponse
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from small_problems import cubic_oscillator

PROBLEM = cubic_oscillator(damping=0.2, drive=1.0)


def fold() -> PeriodicResponse:
    """Return a fold."""
    options = CurveOptions(0.5, 3.0, harmonics=3, samples=64, stability=False)
    found = frequency_response(PROBLEM, static_equilibrium(PROBLEM), options)
    return next(each for each in found if each.event == "fold")


def test_what_is_told_again_is_left_out_and_nothing_else() -> None:
    known = fold()
    place, motion = known.parameter, known.coefficients
    again = replace(known, parameter=place * (1.0 + 1e-7), coefficients=1.01 * motion)
    others = [
        replace(known, event="peak"),
        replace(known, parameter=1.01 * place),
        replace(known, coefficients=1.1 * motion),
    ]

    found = list(ToldEvents().fresh([known, again, *others], rising=True))

    assert [id(each) for each in found] == [id(each) for each in (known, *others)]


def test_folds_to_the_right_and_to_the_left_are_two_close_as_they_may_be() -> None:
    right, told = fold(), ToldEvents()
    left = replace(right, parameter=right.parameter * (1.0 - 1e-7))

    steps = [(right, True), (left, False), (right, True), (left, False)]
    found = [list(told.fresh([each], rising=rising)) for each, rising in steps]

    assert [len(each) for each in found] == [1, 1, 0, 0]


def test_what_is_taken_back_is_told_again() -> None:
    known, told = fold(), ToldEvents()
    peak = replace(known, event="peak")
    list(told.fresh([known, peak], rising=True))

    told.forget([known])

    assert [each.event for each in told.fresh([known, peak], rising=True)] == ["fold"]


@pytest.mark.long
def test_a_curve_that_comes_back_upon_itself_tells_each_event_once() -> None:
    # beside the branch point at 32.25 rad/s a step leads to where it has been before
    names = [f"x{each}" for each in range(1, 6)]
    gaps = (2e-4, 2.093e-4, 2.306e-4, 2e-4, 2e-4)
    problem = system(
        mass=np.ones(5),
        stiffness=600.0 * (np.eye(5) - 0.5 * np.eye(5, k=1) - 0.5 * np.eye(5, k=-1)),
        damping_ratio=0.00486,
        elements=[
            Element(UnilateralSpring(stiffness=1107.0, gap=gap), (name, "ground"))
            for name, gap in zip(names, gaps, strict=True)
        ],
        drive=dict.fromkeys(names, 1.4),
    )
    options = CurveOptions(25.0, 45.0, harmonics=5, errors=False)

    found = list(frequency_response(problem, static_equilibrium(problem), options))

    told = Counter(
        (each.event, round(each.frequency, 4), round(each.coefficients[1, 0], 4))
        for each in found
        if each.event
    )
    assert max(told.values()) == 1
