"""Free decay: the drive is let go, and the motion tells frequency and damping."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from microslip.scenes.experiments import March
from microslip.scenes.quantity import SceneError
from microslip.studies.march_size import demand_end
from microslip_mechanics.contact.memory import beyond_motion
from microslip_mechanics.loads.sine_test import SineTest, Tone
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.energy_damping import energy_damping
from microslip_mechanics.results.ring_down import (
    FEWEST_ROWS,
    RingDown,
    cycle_rows,
    no_swings,
    ring_down,
)
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.checkpoint import at_end
from timedomain.record.driftless import undragged_motions
from timedomain.record.start import Start

ROWS = 60
"""per period at least, if the steps are not longer"""

STILL = 1e-12
"""of where it is, that rounding moves"""
GONE = 1e-2
"""of the largest deflection, below which a decay is over"""
REMEDY = "give a longer march.time_step or fewer --periods"


def released(
    problem: Problem,
    state: Checkpoint | Start,
    march: March,
    *,
    frequency: float,
    periods: int,
) -> Iterator[TimeHistory]:
    """Yield the motion that follows from a state under the preload alone.

    Parameters
    ----------
    problem, march
        What is marched, and in which steps; rows are dense enough to see cycles.
    state
        Where the drive is let go.
    frequency
        [rad/s] of the ``periods`` that are marched.

    Raises
    ------
    SceneError
        If the state is that of another structure, or of other contacts, or if the
        decay would not end.
    """
    dofs = problem.structure.dofs
    if state.displacement.size != dofs:
        raise SceneError(
            f"the motion has {state.displacement.size} degrees of freedom, the scene "
            f"has {dofs}: give the scene of its file"
        )
    hertz = frequency / (2.0 * math.pi)
    loads = SineTest(0.0, 0.0, (Tone(hertz, hertz, periods / hertz, 0.0),), 0.0)
    dense = 1.0 / (ROWS * hertz * march.time_step)
    stride = max(1, int(min(march.store_every, dense)))
    options = MarchOptions(march.time_step, stride)
    demand_end(loads, options, REMEDY)
    start = state if isinstance(state, Start) else _let_go(problem, state)
    for block in integrate(problem, loads, options, start=start):
        still = np.zeros(len(block.time))
        yield replace(block, frequency=still + frequency, level=still)


def _let_go(problem: Problem, state: Checkpoint) -> Start:
    """Return the motion at the end of a march, with what contacts remember.

    What nothing holds is let go at rest, where it began: it does not drift away.
    """
    unheld = undragged_motions(problem)
    try:
        start = at_end(problem, state)
    except ValueError:
        raise SceneError(
            "the motion does not tell what the contacts of the scene remember: give "
            "the scene of its file"
        ) from None
    drift = unheld @ unheld.T @ problem.structure.dense.mass
    displacement = start.displacement - drift @ start.displacement
    return replace(
        start,
        displacement=displacement,
        velocity=start.velocity - drift @ start.velocity,
    )


def measured(problem: Problem, history: TimeHistory, probe: int) -> RingDown:
    """Return frequency and damping of a probe's decay about its place of rest.

    That is the static equilibrium or, where friction depends on the past and may hold
    it anywhere, the middle of the last cycle of the march. Too few rows, or swings,
    give none; nor do swings at the end that have too few, as they are faster.
    """
    if _cycle_rows(problem, history, probe) < FEWEST_ROWS:
        return no_swings()
    found = swings(problem, history, probe)
    return found.until(found.time.size - too_fast(problem, history, probe))


def too_fast(problem: Problem, history: TimeHistory, probe: int) -> int:
    """Return how many swings at the end have too few rows, as where contacts stick."""
    step = float(np.diff(history.time[:2])[0])
    turning = swings(problem, history, probe).frequency * step
    told = np.flatnonzero(FEWEST_ROWS * turning <= 2.0 * math.pi)
    return int(turning.size - 1 - told[-1]) if told.size else turning.size


def swings(
    problem: Problem, history: TimeHistory, probe: int, *, every: int = 1
) -> RingDown:
    """Return what ``every`` so many rows tell of a decay.

    The kinetic energy of what gyroscopic forces couple is not half of its energy, of
    which the rows do not tell the rest: there is no damping by energy.
    """
    time, rest = history.time[::every], _rest(problem, history, probe)
    rows = (each[::every, probe] for each in (history.displacement, history.velocity))
    found = ring_down(time, *rows, rest=rest)
    if problem.structure.gyroscopic:
        return found
    return replace(found, energy_damping=energy_damping(history, found, every=every))


def _cycle_rows(problem: Problem, history: TimeHistory, probe: int) -> float:
    """Return how many rows a cycle of a probe's decay has."""
    rows = history.displacement[:, probe], history.velocity[:, probe]
    return cycle_rows(history.time, *rows, rest=_rest(problem, history, probe))


def unmeasured(problem: Problem, history: TimeHistory, probe: int) -> str:
    """Return why a decay cannot be measured, and what may help."""
    seen, name = history.displacement[:, probe], history.probes[probe]
    away = np.abs(seen - _rest(problem, history, probe))
    size = float(away.max())
    if size <= STILL * float(np.abs(seen).max()):
        return f"{name} does not move when it is let go: give the scene a drive"
    rows = _cycle_rows(problem, history, probe)
    if rows < FEWEST_ROWS:
        return (
            f"{name} has {rows:.2g} rows to a cycle, where frequency and damping need "
            f"{FEWEST_ROWS}: give a shorter march.time_step or a smaller "
            "march.store_every"
        )
    late = away[history.time >= 0.9 * history.time[-1]]
    if late.max() <= GONE * size:
        return (
            f"{name} comes to rest before it has swung to and fro often enough to be "
            "measured: it is damped too strongly, or its contacts hold it"
        )
    return (
        f"{name} does not swing to and fro often enough to be measured: give more "
        "--periods, unless it is damped so strongly that it creeps back to rest"
    )


def _rest(problem: Problem, history: TimeHistory, probe: int) -> float:
    """Return where a probe comes to rest [m]."""
    seen = history.displacement[:, probe]
    if beyond_motion(problem.interface.points):
        period = 2.0 * math.pi / history.frequency[-1]
        last = seen[history.time >= history.time[-1] - period]
        return 0.5 * float(last.max() + last.min())
    at_rest = static_equilibrium(problem).displacement
    return float(problem.probes.rows[probe] @ at_rest)


def liveliest(history: TimeHistory) -> int:
    """Return the place of the probe that moves most, of those that are no slip."""
    swing = np.ptp(history.displacement, axis=0)
    slips = np.array(["-to-" in name for name in history.probes])
    return int(np.argmax(np.where(slips, -1.0, swing)))
