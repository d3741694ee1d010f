"""Methods that are compared, each with settings from loose to tight."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from hbm.curves.periodic_response import periodic_response, settled_response
from microslip.studies.precision.case import Case
from microslip.studies.precision.march import fixed_step
from microslip.studies.precision.orbit import (
    PHASES,
    Orbit,
    drive_work,
    orbit_of,
    samples,
)
from microslip.studies.precision.outsiders import Outsiders
from microslip.studies.precision.result import Result, steady_result
from microslip_mechanics.contact.memory import beyond_motion
from microslip_mechanics.results.response import PeriodicResponse
from timedomain.integrate import MarchOptions
from timedomain.record.start import on_orbit
from timedomain.shooting.shooting import ShootingOptions, periodic_orbit


@dataclass(frozen=True, slots=True)
class Setting:
    """One run of a method."""

    method: str
    name: str
    """the setting in words"""
    run: Callable[[Case, float], Result]
    """of a case and the seconds that a march of two periods may take"""
    ladder: str = ""
    """of settings, each dearer than the one before: when one is over budget, the rest
    is left out"""


def settings(case: Case, *, quick: bool) -> Iterator[Setting]:
    """Yield all settings that a case admits, method by method."""
    yield from _balances(quick)
    yield from _marches(case, quick)
    for steps in 2 ** np.arange(6, 11 if quick else 14):
        run = partial(_shot, steps=int(steps))
        yield Setting("shooting", f"{2 * steps} steps", run)
    try:
        outsiders = Outsiders.of(case)
    except ValueError:
        return  # a contact without a first-order form
    for method, tightest in (("Radau", 8), ("BDF", 8), ("LSODA", 10)):
        powers = (2, 4, 6) if quick else range(2, tightest + 1)
        for power in powers:
            run = partial(outsiders.run, method=method, tolerance=10.0**-power)
            yield Setting(f"scipy {method}", f"tolerance 1e-{power}", run)


def _balances(quick: bool) -> Iterator[Setting]:
    """Yield harmonic balance, by harmonics and samples and by tolerance."""
    for times in (4, 16) if quick else (4, 16, 64):
        for power in range(1, 7 if quick else 10):
            harmonics = 2**power - 1
            count = times * (harmonics + 1)
            if count < 16 or count > 32768:
                continue
            run = partial(_balanced, harmonics=harmonics, count=count)
            said = f"{harmonics} harmonics, {count} samples"
            yield Setting("harmonic balance", said, run, f"{times} samples")
    for power in range(1, 5 if quick else 8):
        run = partial(_settled, error=10.0**-power)
        method = "harmonic balance by tolerance"
        yield Setting(method, f"tolerance 1e-{power}", run)


def _marches(case: Case, quick: bool) -> Iterator[Setting]:
    """Yield microslip's own marches."""
    single = beyond_motion(case.problem.interface.points)
    most = 12 if quick else 15
    for method in ("reference",) if single else ("reference", "fast"):
        for power in range(7, most):
            steps = 2**power
            options = fixed_step(case.frequency, steps, method)
            run = partial(_marched, options=options)
            yield Setting(f"{method} march", f"{steps} steps", run)
    if single:
        return
    for power in range(1, 4 if quick else 7):
        step = math.tau / case.frequency / PHASES
        run = partial(_marched, options=MarchOptions(step, 1, 10.0**-power))
        yield Setting("fast march by tolerance", f"tolerance 1e-{power}", run)


def _balanced(case: Case, _: float, *, harmonics: int, count: int) -> Result:
    """Balance harmonics from the first one; the second of two runs is warm."""
    guess = replace(case.guess, coefficients=case.guess.coefficients[:3])
    for _ in range(2):
        began = time.process_time()
        found = periodic_response(
            case.problem, case.rest, guess, harmonics=harmonics, samples=count
        )
        seconds = time.process_time() - began
    return Result(orbit_of(case.problem, found), case.begun + seconds, marches=False)


def _settled(case: Case, _: float, *, error: float) -> Result:
    """Balance as many harmonics as a tolerance asks for."""
    for _ in range(2):
        began = time.process_time()
        found = settled_response(case.problem, case.rest, case.guess, error=error)
        seconds = time.process_time() - began
    return Result(orbit_of(case.problem, found), case.begun + seconds, marches=False)


def shot(case: Case, guess: PeriodicResponse, steps: int) -> Orbit:
    """Return the orbit by shooting from a guess, of so many steps and twice as many.

    Raises
    ------
    ShootingError
        If none is reached.
    """
    start = on_orbit(case.problem, guess)
    options = ShootingOptions(steps, 1e-15, 2 * steps)
    found = periodic_orbit(case.problem, case.frequency, start=start, options=options)
    work = drive_work(case.problem, found.coefficients @ case.problem.loads[1:].T)
    shown = samples(found.coefficients @ case.problem.probes.rows.T)
    return Orbit(shown, found.friction_energy, work)


def _shot(case: Case, _: float, *, steps: int) -> Result:
    """Shoot from one harmonic; two marches are extrapolated."""
    guess = replace(case.guess, coefficients=case.guess.coefficients[:3])
    began = time.process_time()
    orbit = shot(case, guess, steps)
    seconds = case.begun + time.process_time() - began
    return Result(orbit, seconds, marches=False)


def _marched(case: Case, _: float, *, options: MarchOptions) -> Result:
    """March by one of microslip's methods until the motion is steady."""
    return steady_result(case, partial(case.march, options))
