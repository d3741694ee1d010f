"""The same march by many: each method is a name, a ladder of settings and a function.

A method is given a case and a setting, its tolerances or its step, and returns what
friction took out at the case's times. Another method of microslip is one more line of
:data:`METHODS`.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import sksundae
from scipy.integrate import odeint, solve_ivp

from benchmarks.dop853 import DOP853, integrated
from benchmarks.work_precision import Setting
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from timedomain.first_order.first_order import FirstOrder, Flow, Jacobian
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import Start

MOST_STEPS = 10**8
FIRST_STEP = 1e-7
"""of DOP853, far below any that it settles at [s]"""


@dataclass(frozen=True, slots=True)
class Case:
    """One march that all methods are given."""

    problem: Problem
    sweep: SweptSine
    start: Start
    times: Array
    """at which energies are compared, the first one zero [s], shape (times,)"""
    form: FirstOrder
    flow: Flow
    jacobian: Jacobian

    @property
    def state(self) -> Array:
        """The first state of the first-order form."""
        return self.form.state(self.start)

    def rate(self, time: float, state: Array) -> Array:
        """Return the rate of a state, as scipy wants it."""
        rate = np.empty_like(state)
        self.flow(time, state, rate)
        return rate

    def tangent(self, time: float, state: Array) -> Array:
        """Return the Jacobian of a state, as scipy wants it."""
        matrix = np.empty((state.size, state.size))
        self.jacobian(time, state, matrix)
        return matrix


@dataclass(frozen=True, slots=True)
class March:
    """What a method returns."""

    friction: Array
    """energy taken out at the case's times [J], shape (times,)"""
    closing: float
    """largest error of the energy balance, over the energy put in"""
    success: bool
    """what the solver says of itself"""


@dataclass(frozen=True, slots=True)
class Method:
    """A way to march, and the settings to try, from loose to tight."""

    run: Callable[..., March]
    """of a case and the numbers of a setting"""
    settings: tuple[Setting, ...]


def by_scipy(case: Case, tolerance: float, share: float, *, method: str) -> March:
    """March by one of scipy's solvers."""
    found = solve_ivp(  # type: ignore[call-overload]
        case.rate,
        (case.times[0], case.times[-1]),
        case.state,
        method=method,
        t_eval=case.times,
        rtol=tolerance,
        atol=share * tolerance,
        jac=case.tangent,
    )
    return _measured(case, found.y.T, success=found.success)


def by_lsoda(case: Case, tolerance: float, share: float) -> March:
    """March by LSODA, called as the function whose loop over steps is compiled."""
    states, said = odeint(
        case.rate,
        case.state,
        case.times,
        Dfun=case.tangent,
        tfirst=True,
        full_output=True,
        rtol=tolerance,
        atol=share * tolerance,
        mxstep=MOST_STEPS,
    )
    return _measured(case, states, success="successful" in said["message"])


def by_cvode(case: Case, tolerance: float, share: float, *, order: int) -> March:
    """March by SUNDIALS' CVODE with BDF up to an order."""

    def jacobian(time: float, state: Array, _: Array, matrix: Array) -> None:
        case.jacobian(time, state, matrix)

    solver = sksundae.cvode.CVODE(
        case.flow,
        method="BDF",
        max_order=order,
        rtol=tolerance,
        atol=share * tolerance,
        jacfn=jacobian,
        max_num_steps=MOST_STEPS,
    )
    found = solver.solve(case.times, case.state)
    return _measured(case, found.y, success=found.success)


def by_dop853(case: Case, tolerance: float, share: float) -> March:
    """March by the compiled explicit method of order 8."""
    states, _, _ = integrated(
        DOP853,
        case.form.system,
        case.times,
        case.state,
        tolerance,
        share * tolerance,
        FIRST_STEP,
        MOST_STEPS,
    )
    return _measured(case, states, success=bool(np.isfinite(states).all()))


def by_fixed_dop853(case: Case, step: float) -> March:
    """March by the same with a fixed step."""
    states, _, _ = integrated(
        DOP853, case.form.system, case.times, case.state, 0.0, 0.0, step, MOST_STEPS
    )
    return _measured(case, states, success=bool(np.isfinite(states).all()))


def by_newmark(case: Case, step: float) -> March:
    """March by microslip's average acceleration, its step at most this [s]."""
    interval = case.times[1] - case.times[0]
    stride = int(np.ceil(interval / step - 1e-9))
    options = MarchOptions(interval / stride, store_every=stride, method="reference")
    return by_microslip(case, options)


def by_fast(case: Case, tolerance: float) -> March:
    """March by microslip's method with error control."""
    interval = case.times[1] - case.times[0]
    options = MarchOptions(interval, store_every=1, tolerance=tolerance)
    return by_microslip(case, options)


def by_microslip(case: Case, options: MarchOptions) -> March:
    """March by an integrator of microslip that stores at the case's times."""
    blocks = integrate(
        case.problem, case.sweep, options, start=case.start, block=case.sweep.duration
    )
    history = joined(list(blocks), "complete")
    closing = np.abs(history.closing_error).max() / np.abs(history.of("input")).max()
    friction = np.append(0.0, history.of("friction"))
    return March(friction, float(closing), success=True)


def _measured(case: Case, states: Array, *, success: bool) -> March:
    """Return what states of the first-order form say of energy."""
    whole = np.full((case.times.size, case.state.size), np.nan)
    whole[: len(states)] = states
    energy = case.form.system.energy
    closing = np.abs(case.form.closing_error(whole)).max()
    put_in = energy * np.abs(whole[:, -1]).max()
    return March(energy * whole[:, -3], float(closing / put_in), success=success)


def tolerances(
    loosest: float, tightest: float, *, each_decade: int
) -> tuple[Setting, ...]:
    """Return several relative tolerances a decade, each with both absolute ones."""
    decades = np.log10([loosest, tightest])
    count = each_decade * round(decades[0] - decades[1]) + 1
    return tuple(
        (float(relative), share)
        for share in SHARES
        for relative in np.logspace(decades[0], decades[1], count)
    )


SHARES = (1.0, 1e-3)
"""absolute tolerance, of a state of order one, over the relative one"""
STEPS = tuple((1e-4 / 2.0**halvings,) for halvings in range(9))
TOLERANCES = tuple((10.0**-power,) for power in np.arange(1.5, 8.5, 0.5))
METHODS = {
    "microslip Newmark": Method(by_newmark, STEPS),
    "microslip fast": Method(by_fast, TOLERANCES),
    "scipy Radau": Method(
        functools.partial(by_scipy, method="Radau"),
        tolerances(1e-2, 1e-6, each_decade=1),
    ),
    "scipy BDF": Method(
        functools.partial(by_scipy, method="BDF"), tolerances(1e-3, 1e-6, each_decade=1)
    ),
    "LSODA": Method(by_lsoda, tolerances(1e-3, 1e-8, each_decade=2)),
    "CVODE BDF order 2": Method(
        functools.partial(by_cvode, order=2), tolerances(1e-3, 1e-8, each_decade=2)
    ),
    "CVODE BDF order 5": Method(
        functools.partial(by_cvode, order=5), tolerances(1e-3, 1e-8, each_decade=2)
    ),
    "compiled DOP853": Method(by_dop853, tolerances(1e-3, 1e-8, each_decade=1)),
}
"""all that take part, those of microslip first"""
REFERENCES = (
    functools.partial(by_dop853, tolerance=1e-11, share=1.0),
    functools.partial(by_cvode, order=5, tolerance=1e-8, share=1e-3),
)
"""two that have nothing in common but the right-hand side"""
