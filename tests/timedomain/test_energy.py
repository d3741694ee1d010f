"""Energies: what is measured, how well it balances, how fast it converges."""

from typing import Any

import numpy as np
import pytest

from convergence import observed_order
from microslip_mechanics.element import Element
from microslip_mechanics.laws.elastic_friction import ElasticFriction
from microslip_mechanics.laws.jenkins import Jenkins
from microslip_mechanics.loads.excitation import Dwell, SweptSine
from microslip_mechanics.system import system
from rigs import rig_problem
from small_problems import dwelled, from_rest, marched, sliding_block
from timedomain.integrate import MarchOptions
from timedomain.record.start import Start


@pytest.mark.parametrize(
    "model", [{"model": "B"}, {}, {"friction__law": "gkf"}, {"contact__sigma": 3e-7}]
)
def test_the_energy_balance_of_a_sweep_closes_with_second_order(
    model: dict[str, object],
) -> None:
    problem = rig_problem(**model)
    sweep = SweptSine(
        ramp=0.1, start=0.12, end=0.4, duration=0.4, lowest=130.0, highest=138.0
    )

    steps, errors = [5e-5, 2.5e-5, 1.25e-5], []
    for time_step in steps:
        history = marched(problem, sweep, MarchOptions(time_step))
        closing = np.abs(history.closing_error).max()
        errors.append(closing / history.of("input")[-1])

    assert observed_order(steps, errors) == pytest.approx(2.0, abs=0.1)
    assert errors[1] < 1e-3  # at the default step; measured 1e-4


@pytest.mark.parametrize("law", ["coulomb", "gkf"])
def test_friction_and_damping_only_ever_take_energy(law: str) -> None:
    problem = rig_problem(friction__law=law, contact__sigma=3e-7)

    history = marched(
        problem,
        Dwell(2.0 * np.pi * 135.0, 0.1),
        MarchOptions(store_every=1),
        start=from_rest(problem),
    )

    assert history.friction_power.min() >= 0.0
    for flow in ("friction", "normal_damping", "structural_damping"):
        assert history.of(flow)[0] >= 0.0
        assert np.diff(history.of(flow)).min() >= 0.0


def test_energies_are_integrals_of_the_powers_and_squares_of_the_motion() -> None:
    mass, stiffness, load = 2.0, 8.0, 1.7
    block = sliding_block(mass=mass, stiffness=stiffness, load=load, threshold=0.05)
    start = Start(np.array([0.3]), np.array([1.0]))

    options = MarchOptions(1e-3, 1, method="reference")
    history = marched(block, Dwell(1.0, 2.0), options, start=start)

    moved, moving = history.displacement[:, 0], history.velocity[:, 0]
    np.testing.assert_allclose(history.of("kinetic"), mass * moving**2 / 2.0)
    np.testing.assert_allclose(history.of("elastic"), stiffness * moved**2 / 2.0)
    assert history.stored_at_start == pytest.approx(1.0 + 0.36)
    drag = 0.3 * load * np.minimum(np.abs(moving) / 0.05, 1.0) * np.abs(moving)
    np.testing.assert_allclose(history.friction_power, drag, atol=1e-15)
    first = 0.3 * load * 1.0  # the power at time zero
    powers = np.append(first, drag)
    taken = np.cumsum((powers[1:] + powers[:-1]) / 2.0) * history.time_step
    np.testing.assert_allclose(history.of("friction"), taken, rtol=1e-12)


def stick_slip_energy(threshold: float, steps: int) -> float:
    """Return what friction takes from a driven block on a spring in three periods."""
    block = sliding_block(
        stiffness=8.0, dynamic=0.3, load=1.7, threshold=threshold, drive=1.0
    )
    history = dwelled(block, 1.0, periods=3, steps=steps)
    return float(history.of("friction")[-1])


def test_energy_converges_with_second_order_where_steps_resolve_the_transition() -> (
    None
):
    exact = stick_slip_energy(0.05, 40_960)
    steps = [80, 160, 320, 640]

    errors = [abs(stick_slip_energy(0.05, each) - exact) for each in steps]

    # The force has kinks: the order scatters, depending on where steps meet them.
    order = observed_order([1.0 / each for each in steps], errors)
    assert order == pytest.approx(2.0, abs=0.3)


def test_energy_converges_also_where_steps_jump_over_the_transition() -> None:
    exact = stick_slip_energy(5e-4, 40_960)
    steps = [80, 160, 320, 640]

    errors = [abs(stick_slip_energy(5e-4, each) - exact) for each in steps]

    # From 80 to 640 steps a period, at least with first order.
    assert errors[0] < 1e-2 * exact
    assert errors[-1] < errors[0] / 8.0


@pytest.mark.parametrize("load", ["constant", "varying"])
def test_what_a_slider_stores_is_not_taken_out(load: str) -> None:
    """A mass pushed against a slider, up to where it turns for the first time."""
    stiffness, limit, speed, spring = 1e3, 1.0, 0.1, 2.0
    slider: Jenkins | ElasticFriction = Jenkins(stiffness, limit)
    ends: dict[str, Any] = {"between": ("x", "ground")}
    if load == "varying":
        ends = {"normal": ("n", "ground"), "tangents": [("x", "ground")]}
        slider = ElasticFriction(
            normal_stiffness=1e3, preload=2.0, stiffness=stiffness, mu=0.5
        )
    problem = system(
        names=["x", "n"],
        mass=[1.0, 1.0],
        stiffness=[spring, 1e9],  # so that n stays, and its preload is 2 N
        elements=[Element(slider, **ends, name="slider")],
        drive={"x": 0.0},
    )
    start = Start(np.zeros(2), np.array([speed, 0.0]))

    history = marched(problem, Dwell(1.0, 0.25), MarchOptions(1e-5, 1), start=start)

    moved = history.displacement[:, 0]
    turn = int(np.argmax(moved))
    assert moved[turn] > 4.0 * limit / stiffness
    sticks = moved[:turn] < 0.99 * limit / stiffness
    np.testing.assert_allclose(
        history.of("contact")[:turn][sticks],
        stiffness * moved[:turn][sticks] ** 2 / 2.0 + history.of("contact")[0],
        atol=1e-7,
    )
    np.testing.assert_allclose(history.of("friction")[:turn][sticks], 0.0, atol=1e-9)
    held = limit**2 / stiffness / 2.0 + spring * moved[turn] ** 2 / 2.0
    assert history.of("friction")[turn] == pytest.approx(
        speed**2 / 2.0 - held, rel=1e-5
    )
    assert np.abs(history.closing_error).max() < 1e-8
