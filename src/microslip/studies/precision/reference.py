"""The orbit that all methods are measured by, from two that have little in common."""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import partial

from hbm.curves.periodic_response import periodic_response
from microslip.studies.precision.case import Case
from microslip.studies.precision.march import PERIODS, fixed_step
from microslip.studies.precision.methods import shot
from microslip.studies.precision.orbit import Orbit, orbit_of
from microslip_mechanics.contact.memory import beyond_motion
from timedomain.shooting.steady import steady

SETTLED = 1e-10
"""change of all quantities at which a reference is no longer refined"""
MOST = (2047, 2**16)
"""harmonics and steps"""


@dataclass(frozen=True, slots=True)
class Reference:
    """The orbit by two methods that share nothing but the contact laws."""

    orbit: Orbit
    """by harmonic balance"""
    names: tuple[str, str]
    """of both, at their tightest settings"""
    spread: tuple[float, ...]
    """by how much the other differs, of each of the quantities, relative"""


def reference(case: Case, budget: float) -> Reference:
    """Return the reference, refined as far as a budget of seconds allows."""
    orbit, name = _by_balance(case, budget)
    other, other_name = _by_marches(case, budget)
    return Reference(orbit, (name, other_name), other.errors(orbit))


def _by_balance(case: Case, budget: float) -> tuple[Orbit, str]:
    """Return the orbit by harmonic balance, harmonics doubled until it stands still."""
    harmonics, guess = 63, case.guess
    orbit: Orbit | None = None
    while True:
        began = time.process_time()
        guess = periodic_response(
            case.problem,
            case.rest,
            guess,
            harmonics=harmonics,
            samples=32 * (harmonics + 1),
        )
        fresh = orbit_of(case.problem, guess)
        still = orbit is not None and max(fresh.errors(orbit)) < SETTLED
        spent = time.process_time() - began
        if still or spent > budget / 5.0 or harmonics >= MOST[0]:
            return fresh, f"harmonic balance, {harmonics} harmonics"
        orbit, harmonics = fresh, 2 * harmonics + 1


def _by_marches(case: Case, budget: float) -> tuple[Orbit, str]:
    """Return the orbit by two reference marches, extrapolated.

    By shooting, or by the steady states of two dwells where friction does not follow
    from the motion at one moment.
    """
    steps = 1024
    orbit: Orbit | None = None
    make = _dwelled if beyond_motion(case.problem.interface.points) else _shot
    while True:
        began = time.process_time()
        fresh, name = make(case, steps)
        still = orbit is not None and max(fresh.errors(orbit)) < SETTLED
        spent = time.process_time() - began
        if still or spent > budget or steps >= MOST[1]:
            return fresh, f"{name}, {2 * steps} steps, extrapolated"
        orbit, steps = fresh, 2 * steps


def _shot(case: Case, steps: int) -> tuple[Orbit, str]:
    return shot(case, case.guess, steps), "shooting"


def _dwelled(case: Case, steps: int) -> tuple[Orbit, str]:
    """Return the extrapolated steady state of two reference marches."""
    coarse, fine = (
        steady(
            case.slope,
            partial(case.march, fixed_step(case.frequency, each, "reference")),
            case.start,
            PERIODS,
        ).made.orbit
        for each in (steps, 2 * steps)
    )
    shown = fine.displacement + (fine.displacement - coarse.displacement) / 3.0
    friction = fine.friction + (fine.friction - coarse.friction) / 3.0
    damping = fine.damping + (fine.damping - coarse.damping) / 3.0
    return Orbit(shown, friction, damping), "reference march"
