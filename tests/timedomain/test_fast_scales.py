"""The fast march beside large preloads, of tiny motions, jams and kinks of the load."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from microslip_mechanics.element import Element
from microslip_mechanics.laws.coulomb import RegularisedCoulomb
from microslip_mechanics.laws.dampers import LinearDamper
from microslip_mechanics.laws.polynomial_spring import CubicSpring
from microslip_mechanics.laws.unilateral import UnilateralSpring
from microslip_mechanics.loads.excitation import Dwell, SweptSine
from microslip_mechanics.loads.sine_test import SineTest, Tone, stepped
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import marched
from timedomain.fast.fast import FastMarch
from timedomain.fast.motion import STEPS
from timedomain.integrate import MarchOptions, integrate, whole_steps
from timedomain.record.start import Start, at_rest


def pressed(preload: float, ramp: float = 0.0) -> TimeHistory:
    """Return a march with a tolerance beside a mass that is pressed aside."""
    problem = system(
        mass=[1.0, 0.2, 1.0],
        stiffness=[[1.1e4, -1e3, 0.0], [-1e3, 3e3, 0.0], [0.0, 0.0, 1e4]],
        damping=np.diag([2.0, 0.3, 200.0]),
        names=["x", "z", "y"],
        elements=[
            Element(
                RegularisedCoulomb(load=1.0, mu=0.3, threshold_velocity=1e-4),
                tangents=[("z", "ground")],
            ),
            Element(
                UnilateralSpring(stiffness=1e6, gap=1e-3, damping=20.0),
                between=("x", "ground"),
            ),
        ],
        drive={"x": 1.0},
        preload={"y": preload},
    )
    start = at_rest(problem)
    if ramp == 0.0:
        start = Start(static_equilibrium(problem).displacement, np.zeros(3))
    wait = 2.0 * ramp
    test = SineTest(ramp, wait, (Tone(16.0, 16.0, 1.0),), 0.0)
    options = MarchOptions(2.5e-4, 10, tolerance=1e-3)
    return marched(problem, test, options, start=start)


@pytest.mark.parametrize("ramp", [0.0, 0.25], ids=["there", "grows"])
def test_a_preload_elsewhere_makes_no_step_less_accurate(ramp: float) -> None:
    few, many = pressed(1.0, ramp), pressed(1e5, ramp)

    # energy of the preload counted as the size of the motion: 56 % of it was lost
    for name in ("friction", "normal_damping"):
        assert many.of(name)[-1] == pytest.approx(few.of(name)[-1], rel=1e-4)
    np.testing.assert_allclose(
        many.displacement[:, :2], few.displacement[:, :2], atol=1e-6
    )
    assert many.peak_error[-1] <= 1e-3


@pytest.mark.usefixtures("no_hang")
@pytest.mark.parametrize(
    "law", [pytest.param("coulomb", marks=pytest.mark.long), "gkf"]
)
def test_contacts_that_jam_are_marched_and_their_error_is_told(law: str) -> None:
    problem = rig_problem(friction__law=law, friction__mu_dynamic=1e10)
    history = SweptSine(5e-3, 5e-3, 1e-2, 1e-2, 130.0, 130.2)
    options = MarchOptions(2.5e-5, 10, tolerance=1e-3)

    blocks = list(integrate(problem, history, options, block=2.5e-4))

    # no step was short enough, or millions of the shortest were taken
    found = joined(blocks, "complete")
    assert found.time[-1] == pytest.approx(1e-2)
    # how many steps are left as they are, with a larger error, goes with rounding
    assert found.energy_error[-1] >= 0.99e-3 * found.of("friction")[-1]


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
