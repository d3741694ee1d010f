"""What general solvers get wrong without a word, and that energy closure tells.

The numbers of ``tests/benchmarks/outsiders.py``, as far as scipy alone shows them.
"""

import functools
from typing import Literal

import numpy as np
import pytest
from scipy.integrate import odeint, solve_ivp

from benchmarks.dop853 import DOP853, integrated, real_limit
from hbm.options import CurveOptions
from hbm.solve import frequency_response
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.static import static_equilibrium
from rigs import rig_problem
from timedomain.first_order.first_order import FirstOrder, first_order, flow, jacobian
from timedomain.record.start import Start

HERTZ = 2.0 * np.pi
LOWEST, RATE, WINDOW = 134.5, np.log(145.0 / 125.0) / 6.0, 0.05
SWEEP = SweptSine(0.0, 0.0, WINDOW, WINDOW, LOWEST, LOWEST * np.exp(RATE * WINDOW))
TIMES = np.linspace(0.0, WINDOW, 11)
CLOSES = 1e-2
"""closing error over input from which on no run is believed"""


@functools.cache
def rig(model: str) -> tuple[FirstOrder, Array]:
    """Return the first-order form, and a state on the orbit at the lowest frequency."""
    problem = rig_problem(model=model)
    form = first_order(problem, SWEEP, motion=0.1, energy=1e-3)
    return form, form.state(orbit(problem))


def orbit(problem: Problem) -> Start:
    options = CurveOptions(
        HERTZ * LOWEST, HERTZ * 1.001 * LOWEST, harmonics=15, stability=False
    )
    response = next(frequency_response(problem, static_equilibrium(problem), options))
    displacement, velocity = response.at(np.zeros(1))
    return Start(displacement[0], velocity[0])


@functools.cache
def exact(model: str) -> Array:
    """Return what friction takes out, by the explicit method at a tight tolerance."""
    form, state = rig(model)
    states, _, _ = integrated(
        DOP853, form.system, TIMES, state, 1e-9, 1e-9, 1e-7, 10**7
    )
    return friction(states)


def friction(states: Array) -> Array:
    return 1e-3 * states[:, -3]


def rate(time: float, state: Array, form: FirstOrder) -> Array:
    written = np.empty_like(state)
    flow(form.system, time, state, written)
    return written


def tangent(time: float, state: Array, form: FirstOrder) -> Array:
    written = np.empty((state.size, state.size))
    jacobian(form.system, time, state, written)
    return written


def errors(model: str, states: Array) -> tuple[float, float]:
    """Return the error of friction's energy, and the closing error over the input."""
    away = np.abs(friction(states) - exact(model)).max() / exact(model)[-1]
    put_in = 1e-3 * np.abs(states[:, -1]).max()
    closing = np.abs(rig(model)[0].closing_error(states)).max() / put_in
    return float(away), float(closing)


def by_lsoda(relative: float, absolute: float) -> Array:
    form, state = rig("A")
    states, said = odeint(
        rate,
        state,
        TIMES,
        args=(form,),
        Dfun=tangent,
        tfirst=True,
        full_output=True,
        rtol=relative,
        atol=absolute,
        mxstep=10**6,
    )
    assert said["message"] == "Integration successful."
    found: Array = states
    return found


def by_scipy(
    method: Literal["BDF", "Radau"], relative: float, absolute: float
) -> Array:
    form, state = rig("A")
    found = solve_ivp(
        lambda time, state: rate(time, state, form),
        (0.0, WINDOW),
        state,
        method=method,
        t_eval=TIMES,
        rtol=relative,
        atol=absolute,
        jac=lambda time, state: tangent(time, state, form),
    )
    assert found.success
    states: Array = found.y.T
    return states


@pytest.mark.parametrize(
    ("method", "tolerance", "least"),
    [("LSODA", 1e-2, 0.6), ("LSODA", 3e-3, 0.1), ("BDF", 1e-3, 0.1)],
)
def test_high_order_bdf_is_wrong_with_success_reported_and_closure_tells(
    method: str, tolerance: float, least: float
) -> None:
    if method == "LSODA":
        states = by_lsoda(tolerance, tolerance)
    else:
        states = by_scipy("BDF", tolerance, tolerance)

    away, closing = errors("A", states)

    assert away > least
    assert closing > 10.0 * CLOSES


def test_a_tight_tolerance_is_right_and_closure_agrees() -> None:
    away, closing = errors("A", by_lsoda(1e-4, 1e-7))

    assert away < 1e-4
    assert closing < 0.01 * CLOSES


def test_a_dissipative_method_errs_less_at_a_loose_tolerance() -> None:
    away, closing = errors("A", by_scipy("Radau", 1e-2, 1e-5))

    assert away < 1e-2
    assert closing < CLOSES


@pytest.mark.long
@pytest.mark.slow
def test_explicit_steps_above_the_friction_limit_are_wrong_but_do_not_blow_up() -> None:
    form, state = rig("full")
    rates = np.linalg.eigvals(tangent(0.0, state, form))
    limit = real_limit(DOP853) / -float(rates.real.min())

    below, above = (
        integrated(DOP853, form.system, TIMES, state, 0.0, 0.0, share * limit, 10**7)[0]
        for share in (0.95, 1.02)
    )

    size = np.abs(below[:, :-3]).max()
    assert errors("full", below)[0] < 1e-6
    assert np.abs(above[:, :-3] - below[:, :-3]).max() < 1e-3 * size
    assert 5e-3 < errors("full", above)[0] < 0.5
    assert errors("full", above)[1] < CLOSES  # closure alone does not tell
