"""The first-order form that other solvers are given, and the compiled DOP853."""

import dataclasses

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from benchmarks.dop853 import DOP853, integrated, real_limit
from convergence import observed_order
from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.points import ELASTIC, PointLaw, contact_table
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.problem import Problem
from rigs import rig_problem
from small_problems import from_rest, marched, mass_on_contact, oscillator
from timedomain.first_order.first_order import FirstOrder, first_order, flow, jacobian
from timedomain.integrate import MarchOptions
from timedomain.record.start import Start, first_state

SWEEP = SweptSine(0.001, 0.002, 0.018, 0.02, 130.0, 140.0)
SMOOTH = SweptSine(0.0, 0.0, 0.02, 0.02, 130.0, 140.0)
MOST = 10**6


def formed(problem: Problem, sweep: SweptSine = SWEEP) -> FirstOrder:
    return first_order(problem, sweep, motion=0.1, energy=1e-3)


def in_contact(problem: Problem) -> Start:
    """Return a motion with all contacts closed, some of which slide."""
    rest = from_rest(problem).displacement
    draw = np.random.default_rng(3)
    return Start(rest, 1e-3 * draw.normal(size=rest.size))


def turning(problem: Problem, coriolis: float) -> Problem:
    """Return a problem with Coriolis terms [N s/m] between neighbouring motions."""
    structure = problem.structure
    across = np.triu(np.ones((structure.dofs, structure.dofs)), 1)
    across = (
        coriolis
        * (across - across.T)
        * np.sqrt(np.outer(structure.mass.diagonal(), structure.mass.diagonal()))
    )
    turned = dataclasses.replace(
        structure, damping=structure.damping + across, gyroscopic=True
    )
    return dataclasses.replace(problem, structure=turned)


def rate_of(form: FirstOrder, time: float, state: Array) -> Array:
    rate = np.empty_like(state)
    flow(form.system, time, state, rate)
    return rate


def ran(
    form: FirstOrder, start: Start, times: Array, tolerance: float, step: float = 1e-7
) -> tuple[Array, int, int]:
    return integrated(
        DOP853, form.system, times, form.state(start), tolerance, tolerance, step, MOST
    )


@pytest.mark.parametrize(
    "variant", [{}, {"model": "A"}, {"model": "B", "friction__law": "gkf"}]
)
def test_the_rate_is_that_of_the_march_s_first_state(
    variant: dict[str, object],
) -> None:
    problem = rig_problem(**variant)
    form, start = formed(problem), in_contact(problem)
    settled = dataclasses.replace(SWEEP, ramp=0.0, start=0.0)
    state = first_state(problem, settled, start)

    rate = rate_of(formed(problem, settled), 0.0, form.state(start))

    count, unit = form.modes.shape[1], form.system.motion
    moving, accelerated = rate[:count], rate[count : 2 * count]
    velocity = form.modes @ moving * (unit / form.system.scale)
    acceleration = form.modes @ accelerated * unit
    size = np.abs(state.acceleration).max()
    np.testing.assert_allclose(velocity, start.velocity, atol=1e-12)
    np.testing.assert_allclose(acceleration, state.acceleration, atol=1e-9 * size)


@pytest.mark.parametrize("time", [0.0004, 0.0015, 0.007, 0.0195])
def test_the_load_is_that_of_the_swept_sine(time: float) -> None:
    problem = oscillator(preload=0.7)
    still = np.zeros(5)

    rate = rate_of(formed(problem), time, still)

    steady, sine = factors_over(SWEEP.segments(), np.array([time]))[0]
    load = (0.7 * steady + 1.5 * sine) / np.sqrt(2.0)  # of mass 2, normalised
    assert rate[1] == pytest.approx(load / 0.1, rel=1e-9)


@pytest.mark.parametrize("coriolis", [0.0, 3.0])
@pytest.mark.parametrize(
    "variant", [{}, {"model": "A"}, {"model": "B", "friction__law": "gkf"}]
)
def test_the_jacobian_is_the_derivative_of_the_rate(
    variant: dict[str, object], coriolis: float
) -> None:
    problem = rig_problem(**variant)
    if coriolis:
        problem = turning(problem, coriolis)
    form = formed(problem)
    state = form.state(in_contact(problem))
    matrix = np.empty((state.size, state.size))

    jacobian(form.system, 0.007, state, matrix)

    for column in range(state.size):
        change = np.zeros_like(state)
        change[column] = 1e-10
        ahead, back = (
            rate_of(form, 0.007, state + sign * change) for sign in (1.0, -1.0)
        )
        difference = (ahead - back) / 2e-10
        size = np.abs(matrix[:, column]).max() + 1.0
        assert np.abs(matrix[:, column] - difference).max() < 1e-3 * size
    # the row of the energy, which is small beside those of the motion
    speeds = slice((state.size - 3) // 2, state.size - 3)
    drained = np.array(
        [
            rate_of(form, 0.007, state + step)[-2]
            - rate_of(form, 0.007, state - step)[-2]
            for step in 1e-8 * np.eye(state.size)[speeds]
        ]
    )
    size = np.abs(matrix[-2, speeds]).max()
    np.testing.assert_allclose(
        matrix[-2, speeds], 0.5e8 * drained, rtol=0.0, atol=1e-4 * size
    )


def test_a_negative_stiffness_pushes_away() -> None:
    form = formed(oscillator(mass=1.0, damping=0.3, stiffness=-2.0))
    away = Start(np.array([0.1]), np.zeros(1))

    rate = rate_of(form, 0.0, form.state(away))

    assert form.motion(rate)[1] == pytest.approx(0.2)


def slider() -> Problem:
    """Return a mass on an elastic slider of 0.2 N behind 500 N/m."""
    points = contact_table(
        [PointLaw(friction=ELASTIC, tangential=500.0, dynamic=0.4, constant_load=True,
                  load=0.5)]
    )  # fmt: skip
    return mass_on_contact(points, direction=1, stiffness=300.0, drive=1.5)


def test_a_slider_s_traction_comes_back() -> None:
    start = Start(np.array([1e-3]), np.array([0.2]), np.array([[0.15, 0.0]]))

    form = formed(slider(), SMOOTH)
    back = form.start(form.state(start))

    assert back.traction is not None
    np.testing.assert_allclose(back.displacement, start.displacement)
    np.testing.assert_allclose(back.velocity, start.velocity)
    assert back.traction[0, 0] == pytest.approx(0.15)
    assert back.traction[0, 1] == 0.0


@pytest.mark.parametrize("traction", [0.15, 0.2])
def test_the_jacobian_knows_whether_a_slider_slides(traction: float) -> None:
    form = formed(slider(), SMOOTH)
    held = np.array([[traction, 0.0]])
    state = form.state(Start(np.array([1e-3]), np.array([0.2]), held))
    matrix = np.empty((state.size, state.size))

    jacobian(form.system, 0.007, state, matrix)

    # along the motion: across the slider's limit the rate has a step
    for column in (0, 1):
        change = np.zeros_like(state)
        change[column] = 1e-6
        ahead, back = (
            rate_of(form, 0.007, state + sign * change) for sign in (1.0, -1.0)
        )
        np.testing.assert_allclose(
            matrix[:, column], (ahead - back) / 2e-6, rtol=1e-5, atol=1e-6
        )
    rate = rate_of(form, 0.007, state)
    assert (rate[2] == 0.0) == (traction == 0.2)


@pytest.mark.long
def test_tight_tolerances_close_the_energy_balance() -> None:
    problem = rig_problem(model="B")
    form = formed(problem)

    states, _, _ = ran(form, in_contact(problem), np.linspace(0.0, 0.02, 5), 1e-10)

    put_in = form.system.energy * np.abs(states[:, -1]).max()
    assert np.abs(form.closing_error(states)).max() < 1e-9 * put_in


@pytest.mark.long
def test_newmark_s_energy_converges_to_that_of_the_first_order_form() -> None:
    problem = rig_problem(model="A")
    start = from_rest(problem)
    states, _, _ = ran(formed(problem, SMOOTH), start, np.array([0.0, 0.02]), 1e-10)
    exact = 1e-3 * states[-1, -3]

    steps, errors = [1e-5, 5e-6, 2.5e-6], []
    for step in steps:
        options = MarchOptions(step, method="reference")
        history = marched(problem, SMOOTH, options, start=start)
        errors.append(abs(history.of("friction")[-1] / exact - 1.0))

    assert observed_order(steps, errors) == pytest.approx(2.0, abs=0.3)
    assert errors[-1] < 1e-4


def test_fixed_steps_converge_with_order_eight() -> None:
    problem = oscillator(stiffness=3e5, damping=50.0, preload=0.0, drive=0.0)
    form = formed(problem)
    start, times = Start(np.array([1e-3]), np.array([0.2])), np.array([0.0, 0.02])
    decay, natural = 12.5, np.sqrt(3e5 / 2.0 - 12.5**2)
    sine, cosine = np.sin(natural * 0.02), np.cos(natural * 0.02)
    exact = np.exp(-decay * 0.02) * (
        1e-3 * cosine + (0.2 + decay * 1e-3) / natural * sine
    )

    steps, errors = [0.02 / 4, 0.02 / 8, 0.02 / 16], []
    for step in steps:
        states, _, _ = ran(form, start, times, 0.0, step)
        moved, _ = form.motion(states[-1])
        errors.append(abs(moved[0] - exact))

    assert observed_order(steps, errors) == pytest.approx(8.0, abs=0.5)


def test_it_steps_as_scipy_s_does() -> None:
    problem = oscillator(stiffness=3e5, preload=1.0)
    form, start = formed(problem, SMOOTH), Start(np.array([1e-3]), np.zeros(1))
    found = solve_ivp(
        lambda time, state: rate_of(form, time, state),
        (0.0, 0.02),
        form.state(start),
        method="DOP853",
        rtol=1e-6,
        atol=1e-6,
        first_step=0.019,
    )

    states, accepted, rejected = ran(form, start, np.array([0.0, 0.02]), 1e-6, 0.019)

    assert accepted == found.t.size - 1
    assert 12 * (accepted + rejected) + 1 == found.nfev
    assert rejected > 0
    np.testing.assert_allclose(states[-1], found.y[:, -1], rtol=1e-12, atol=1e-12)


def test_it_is_stable_up_to_its_limit_on_the_negative_real_axis() -> None:
    limit = real_limit(DOP853)
    problem = oscillator(stiffness=0.0, damping=2.0 * 1e4, drive=0.0)
    form = formed(problem)
    start = Start(np.zeros(1), np.ones(1))

    ends = []
    for share in (0.98, 1.05):
        step = share * limit / 1e4
        times = np.array([0.0, 200.0 * step])
        states, _, _ = ran(form, start, times, 0.0, step)
        ends.append(abs(states[-1, 1]) / states[0, 1])

    assert ends[0] < 1.0 < ends[1]


def test_too_many_steps_leave_no_number() -> None:
    problem = oscillator()
    form = formed(problem)

    states, accepted, rejected = integrated(
        DOP853,
        form.system,
        np.array([0.0, 0.01]),
        np.zeros(5),
        1e-8,
        1e-8,
        1e-6,
        3,
    )

    assert accepted + rejected == 3
    assert np.isnan(states[-1]).all()
