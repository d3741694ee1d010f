"""Swept sines in plain Python."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from microslip.api.arguments import check_apart, checked, named, read
from microslip.scenes.experiments import HERTZ, LONGEST, March
from microslip.scenes.quantity import quantity

if TYPE_CHECKING:
    from microslip_mechanics.problem import Problem
    from microslip_mechanics.results.time_history import TimeHistory

NAME = "microslip.sweep"
REMEDY = (
    "give a longer time_step, a larger store_every, a shorter duration or ramp, or "
    "lower frequencies"
)


@dataclass(frozen=True, slots=True)
class Swept:
    """The swept sine of :func:`sweep`."""

    lowest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    highest: float = quantity("Hz", lowest=HERTZ[0], highest=HERTZ[1])
    duration: float = quantity("s", positive=True, highest=LONGEST)
    ramp: float = quantity("s", lowest=0.0, highest=LONGEST)
    tolerance: float | None = quantity(lowest=1e-14, highest=0.5, optional=True)


def sweep(
    problem: Problem,
    lowest: float | str,
    highest: float | str,
    *,
    duration: float | str,
    time_step: float | str,
    ramp: float | str = 0.0,
    store_every: int = 1,
    tolerance: float | None = None,
) -> TimeHistory:
    """Return the march through an exponential swept sine.

    Parameters
    ----------
    problem
        From :func:`microslip.system` or :func:`microslip.scene`.
    lowest, highest
        Frequency at the start and at the end of the sweep [Hz].
    duration
        Of the sweep, after the ramp [s].
    time_step
        [s]; with a tolerance that of what is stored alone.
    ramp
        Time in which the preload grows before the sweep [s].
    store_every
        Steps per stored time.
    tolerance
        Relative error of friction's energy and of the largest amplitude, from which
        the steps follow; equal steps if left out. Contacts that remember, or are
        rigid, are marched with equal steps in any case.

    Returns
    -------
    TimeHistory
        ``time`` [s] and ``frequency`` of the drive [rad/s]; ``displacement`` [m] and
        ``velocity`` [m/s], (times, probes); ``normal_force`` [N], (times, contacts);
        ``of("friction")`` [J], what friction took out so far.

    Raises
    ------
    MicroslipError
        If an argument is of no use, or if the first steps fail; else ``ending`` says
        how the march ends: "complete" only if its energies balance.
    """
    from microslip.studies.march_size import demand_end
    from microslip.studies.sweep import march_sweep
    from microslip_mechanics.loads.excitation import SweptSine
    from timedomain.options import MarchOptions
    from timedomain.record.closure import OPEN, closes

    march: March = read(NAME, March, time_step=time_step, store_every=store_every)
    swept: Swept = read(
        NAME,
        Swept,
        lowest=lowest,
        highest=highest,
        duration=duration,
        ramp=ramp,
        tolerance=tolerance,
    )
    check_apart(NAME, swept.lowest, swept.highest)
    begin, end = swept.ramp, swept.ramp + swept.duration
    loads = SweptSine(begin, begin, end, end, swept.lowest, swept.highest)
    given = checked(NAME, problem)
    options = MarchOptions(march.time_step, march.store_every, swept.tolerance)
    with named(NAME):
        demand_end(loads, options, REMEDY)
        history = march_sweep(given, loads, march, tolerance=swept.tolerance)
    if history.ending != "complete" or closes(history):
        return history
    remedy = _remedy(given, swept.tolerance)
    return replace(history, ending=f"{OPEN}: {remedy}")


def _remedy(problem: Problem, tolerance: float | None) -> str:
    """Return what closes the balance of a march with or without a tolerance."""
    from microslip_mechanics.contact.memory import beyond_motion

    if beyond_motion(problem.interface.points):
        return "give a shorter time_step"
    if tolerance is None:
        return "give a shorter time_step, or a tolerance"
    return "give a smaller tolerance"
