"""The fast march of tiny motions, of loads with many kinks, and what it stores."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from microslip_mechanics.element import Element
from microslip_mechanics.excitation import Dwell
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.dampers import LinearDamper
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.problem import Problem
from microslip_mechanics.sine_test import SineTest, Tone, stepped
from microslip_mechanics.system import system
from small_problems import marched
from timedomain.fast import FastMarch
from timedomain.integrate import MarchOptions, whole_steps
from timedomain.motion import STEPS
from timedomain.start import Start, at_rest


@pytest.mark.parametrize("size", [1.0, 1e-3, 1e-6, 1e-9])
def test_a_free_decay_has_no_size_of_its_own(size: float) -> None:
    problem = system(
        mass=[1.0],
        stiffness=[1.0],
        elements=[Element(CubicSpring(cubic=size**-2), between=("x1", "ground"))],
    )
    begin = Start(np.array([size]), np.zeros(1))

    end = marched(problem, Dwell(1.0, 50.0), MarchOptions(1e-2, 100), start=begin)

    exact = solve_ivp(
        lambda _, state: (state[1], -state[0] - state[0] ** 3),
        (0.0, 50.0),
        (1.0, 0.0),
        rtol=1e-10,
        atol=1e-12,
    ).y[0, -1]
    # 1 nm moved as if the spring were not there
    assert end.displacement[-1, 0] == pytest.approx(exact * size, rel=1e-3)


@pytest.mark.parametrize("method", ["fast", "reference"])
def test_the_stored_force_of_a_damper_is_that_of_the_stored_velocity(
    method: str,
) -> None:
    problem = system(
        mass=[1.0],
        stiffness=[1e4],
        damping=[2.0],
        elements=[Element(LinearDamper(damping=5.0), between=("x1", "ground"))],
        drive={"x1": 1.0},
    )

    options = MarchOptions(1.0 / 640.0, 1, method=method)  # type: ignore[arg-type]
    history = marched(problem, Dwell(100.0, 0.3), options)

    expected = 5.0 * history.velocity[:, 0]
    np.testing.assert_allclose(history.normal_force[:, 0], expected, rtol=1e-9)


def steps_of(problem: Problem, test: SineTest) -> int:
    """Return how many steps a march with a tolerance takes."""
    rows = round(test.duration / 2.5e-3)
    options = MarchOptions(2.5e-4, 10, tolerance=1e-3)
    march = FastMarch(problem, test, options, 10 * rows, at_rest(problem))
    march.block(0, 10 * rows)
    return int(march._motion.counts[STEPS])


def test_kinks_of_the_load_leave_no_tiny_steps_behind() -> None:
    problem = system(
        mass=[1.0],
        stiffness=[1e4],
        damping=[2.0],
        elements=[
            Element(
                RegularisedCoulomb(load=1.0, mu=0.3, threshold_velocity=1e-3),
                tangents=[("x1", "ground")],
            )
        ],
        drive={"x1": 1.0},
    )
    tones = stepped(np.linspace(15.0, 17.0, 20), periods=2)

    smooth = steps_of(problem, SineTest(0.0, 0.0, (Tone(16.0, 16.0, 2.5),), 0.0))
    kinked = steps_of(problem, SineTest(0.0, 0.0, tuple(tones), 0.0))

    # it was fifty times as many
    assert kinked < 1.5 * smooth


@pytest.mark.parametrize("hertz", [99.9, 99.903, 99.907, 99.908, 50.1])
def test_whole_periods_of_many_steps_have_no_step_more(hertz: float) -> None:
    for periods, steps in ((5000, 10010), (200_000, 810)):
        assert whole_steps(periods / hertz, 1.0 / hertz / steps) == periods * steps


def test_a_step_that_does_not_divide_the_time_is_shortened() -> None:
    assert whole_steps(1.0, 0.3) == 4
    assert whole_steps(1.0, 5.0) == 1
