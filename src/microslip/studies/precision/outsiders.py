"""scipy's solvers on the same equations, as outsiders."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.integrate import odeint, solve_ivp

from microslip.studies.precision.case import Case
from microslip.studies.precision.march import PERIODS, Carried
from microslip.studies.precision.orbit import PHASES, Orbit, drive_work
from microslip.studies.precision.result import Result, steady_result
from microslip_mechanics.arrays import TINY, Array
from microslip_mechanics.loads.excitation import Dwell
from timedomain.first_order.first_order import FirstOrder, Flow, Jacobian, first_order
from timedomain.record.start import Start

SHARE = 1e-3
"""absolute tolerance of a state of order one, over the relative one"""
MOST_STEPS = 10**7
LOOKS = 64
"""calls of a rate between two looks at the clock"""


class OverBudgetError(Exception):
    """A run that takes longer than it may."""


@dataclass(frozen=True, slots=True)
class Outsiders:
    """The equations as scipy's solvers are given them, compiled."""

    form: FirstOrder
    flow: Flow
    jacobian: Jacobian

    @classmethod
    def of(cls, case: Case) -> Outsiders:
        """Return them, scaled by the motion.

        Raises
        ------
        ValueError
            If a contact has no first-order form.
        """
        energy = max(drive_work(case.problem, case.guess.seen(case.problem.loads[1:])),
                     TINY)  # fmt: skip
        dwell = Dwell(case.frequency, case.duration)
        form = first_order(
            case.problem, dwell, motion=case.slope.vibration, energy=energy
        )
        made = cls(form, *form.compiled())
        state = form.state(case.start)
        made.flow(0.0, state, np.empty_like(state))
        made.jacobian(0.0, state, np.empty((state.size, state.size)))
        return made

    def run(
        self, case: Case, budget: float, *, method: str, tolerance: float
    ) -> Result:
        """March until the motion is steady."""
        march = self._lsoda if method == "LSODA" else partial(self._scipy, method)
        return steady_result(
            case, partial(self._carried, case, budget, march, tolerance)
        )

    def _carried(
        self,
        case: Case,
        budget: float,
        march: Callable[[Array, Array, float, Watched], Array],
        tolerance: float,
        start: Start,
    ) -> Carried:
        """March :data:`PERIODS` periods from a motion."""
        times = case.duration / PERIODS / PHASES * np.arange(PERIODS * PHASES + 1)
        watched = Watched(self.flow, self.jacobian, time.process_time() + budget)
        began = time.process_time()
        states = march(times, self.form.state(start), tolerance, watched)
        seconds = (time.process_time() - began) / PERIODS
        last = states[-1 - PHASES :]
        friction, others = self.form.system.energy * (last[-1] - last[0])[-3:-1]
        moved, _ = self.form.motion(last[:-1])
        shown = moved @ case.problem.probes.rows.T
        orbit = Orbit(shown, float(friction), float(friction + others))
        return Carried(self.form.start(states[-1]), orbit, seconds)

    @staticmethod
    def _scipy(
        method: str, times: Array, state: Array, tolerance: float, watched: Watched
    ) -> Array:
        with np.errstate(all="ignore"):  # what overflows is seen from its states
            found = solve_ivp(  # type: ignore[call-overload]
                watched.rate,
                (times[0], times[-1]),
                state,
                method=method,
                t_eval=times,
                rtol=tolerance,
                atol=SHARE * tolerance,
                jac=watched.tangent,
            )
        return _whole(found.y.T, times)

    @staticmethod
    def _lsoda(times: Array, state: Array, tolerance: float, watched: Watched) -> Array:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # what it says is seen from its states
            states, said = odeint(
                watched.rate,
                state,
                times,
                Dfun=watched.tangent,
                tfirst=True,
                full_output=True,
                rtol=tolerance,
                atol=SHARE * tolerance,
                mxstep=MOST_STEPS,
            )
        good = "successful" in said["message"]
        return _whole(states if good else states[:0], times)


def _whole(states: Array, times: Array) -> Array:
    """Return the states, all of them.

    Raises
    ------
    ArithmeticError
        If some are missing.
    """
    if len(states) < times.size or not np.isfinite(states).all():
        raise ArithmeticError("the solver gave up")
    return states


class Watched:
    """Rate and derivative as scipy wants them, with an eye on the clock."""

    def __init__(self, flow: Flow, jacobian: Jacobian, deadline: float) -> None:
        self._flow, self._jacobian, self._deadline = flow, jacobian, deadline
        self._calls = 0

    def rate(self, now: float, state: Array) -> Array:
        """Return the rate of a state.

        Raises
        ------
        OverBudgetError
            If the time is up.
        """
        self._calls += 1
        if self._calls % LOOKS == 0 and time.process_time() > self._deadline:
            raise OverBudgetError
        rate = np.empty_like(state)
        self._flow(now, state, rate)
        return rate

    def tangent(self, now: float, state: Array) -> Array:
        """Return the derivative of the rate by the state."""
        matrix = np.empty((state.size, state.size))
        self._jacobian(now, state, matrix)
        return matrix
