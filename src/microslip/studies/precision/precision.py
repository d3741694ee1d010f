"""Error against run time: every method at every setting beside one reference."""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from microslip.errors import one_line
from microslip.studies.precision.case import Case
from microslip.studies.precision.methods import Setting
from microslip.studies.precision.orbit import QUANTITIES
from microslip.studies.precision.outsiders import OverBudgetError
from microslip.studies.precision.reference import Reference
from microslip.studies.precision.result import Result
from microslip_mechanics.errors import MicroslipError

ASKED = (1e-2, 1e-3, 1e-6)
"""errors at which costs are compared"""
SURE = 10.0
"""times by which an error must exceed what the reference is known to"""
LEFT = 0.1
"""distance from its own steady state at which a march says nothing"""
BUDGET, QUICK = 6.0, 1.0
"""seconds that a march of two periods may take, and refining a reference"""


@dataclass(frozen=True, slots=True)
class Run:
    """One method at one setting."""

    method: str
    setting: str
    seconds: float
    """of one thread's processor, from nothing to the steady state; NaN if it failed"""
    errors: tuple[float, ...]
    """relative, of each of the quantities; of a march with what is left to go"""
    period: float
    """seconds of a march of one period; NaN if the method marches none"""
    periods: int
    """that pass before a march is steady to its own error"""
    left: float
    """distance from its own steady state at which it was measured"""
    ending: str
    """"complete", or the cause"""


def runs(
    case: Case, exact: Reference, chosen: Sequence[Setting], *, quick: bool
) -> Iterator[Run]:
    """Yield a run for each setting; what fails or takes too long is a result too."""
    budget = QUICK if quick else BUDGET
    over: set[tuple[str, str]] = set()
    for setting in chosen:
        ladder = setting.method, setting.ladder
        if ladder in over:
            yield _failed(setting, "left out: a looser setting takes too long")
            continue
        began = time.process_time()
        try:
            result = setting.run(case, budget)
        except OverBudgetError:
            over.add(ladder)
            yield _failed(setting, f"left out: two periods take over {budget:g} s")
        except (MicroslipError, ValueError, ArithmeticError, RuntimeWarning) as cause:
            yield _failed(setting, one_line(cause))
        else:
            if time.process_time() - began > 2.0 * budget:
                over.add(ladder)
            yield _run(case, exact, setting, result)


def _failed(setting: Setting, cause: str) -> Run:
    nothing = (np.nan,) * len(QUANTITIES)
    return Run(setting.method, setting.name, np.nan, nothing, np.nan, 0, np.nan, cause)


def _run(case: Case, exact: Reference, setting: Setting, result: Result) -> Run:
    """Return what a result costs and how wrong it is.

    A march from rest has its transient to wait for: as many periods as the slowest
    multiplier needs to bring it below the error of the orbit. What is left to go to
    the method's own steady state counts as error.
    """
    errors = result.orbit.errors(exact.orbit)
    if not result.marches:
        return Run(
            setting.method,
            setting.name,
            result.seconds,
            errors,
            np.nan,
            0,
            0.0,
            "complete",
        )
    if not result.left < LEFT:
        return _failed(setting, f"not steady: {result.left:.1e} is left to go")
    amplitude, energy, distance = (each + result.left for each in errors)
    periods = case.slope.periods(distance)
    return Run(
        setting.method,
        setting.name,
        periods * result.seconds,
        (amplitude, energy, distance),
        result.seconds,
        periods,
        result.left,
        "complete",
    )
