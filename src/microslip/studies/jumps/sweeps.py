"""Swept sines that pass a fold until the motion has jumped."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np

from microslip.studies.jumps.folds import Fold
from microslip.studies.march_size import demand_end
from microslip.studies.verify.verify import StudyError, envelope_of
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import SweptSine
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.joined import joined
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.start import on_orbit

STEPS, ROWS = 200, 20
"""taken and stored per period; another march takes half as many steps"""
BLOCK = 200
"""periods after which one looks whether the motion has jumped"""

Envelope: TypeAlias = tuple[Array, Array]
"""frequency [Hz] and largest deflection of the fold's probe [m] of each cycle"""
Sweep: TypeAlias = tuple[float, float, Envelope]
"""where it jumps, and where with steps twice as long [Hz]; its envelope"""


def swept_through(problem: Problem, fold: Fold, rate: float) -> Sweep:
    """Sweep through a fold with :data:`STEPS` per period, and with half as many."""
    place, envelope = _marched(problem, fold, rate, STEPS)
    other, _ = _marched(problem, fold, rate, STEPS // 2)
    return place, other, envelope


def _marched(
    problem: Problem, fold: Fold, rate: float, steps: int
) -> tuple[float, Envelope]:
    """March through a fold until the motion has jumped.

    Return where [Hz], and the envelope.

    Raises
    ------
    StudyError
        If it does not jump before the sweep's end.
    SceneError
        If the sweep would not end.
    """
    begin = fold.begin.frequency / (2.0 * np.pi)
    duration = abs(fold.end - begin) / rate
    sweep = SweptSine(0.0, 0.0, duration, duration, begin, fold.end)
    options = MarchOptions(1.0 / (steps * fold.hertz), steps // ROWS)
    demand_end(sweep, options, "give faster --rates")
    start = on_orbit(problem, fold.begin)
    blocks = []
    for block in integrate(
        problem, sweep, options, start=start, block=BLOCK / fold.hertz
    ):
        blocks.append(block)
        history = joined(blocks, "complete")
        driven = sweep.frequency(history.time)
        hertz, every = envelope_of(history, driven, 0.0, duration)
        envelope = every[:, fold.probe]
        place = _passed(fold, hertz, envelope)
        if place is not None:
            return place, (hertz, envelope)
    raise StudyError(
        f"no jump within {abs(fold.end - fold.hertz):.3g} Hz behind the fold at "
        f"{fold.hertz:.6g} Hz at {rate:.3g} Hz/s: give slower sweeps, or a longer lead"
    )


def _passed(fold: Fold, hertz: Array, envelope: Array) -> float | None:
    """Return the frequency at which an envelope leaves the fold's side of the height.

    That is where it first does so behind the fold or, if it is on the other side there
    already, where it last has before. None if it has not [Hz].
    """
    beyond = hertz > fold.hertz if fold.upward else hertz < fold.hertz
    stays = envelope > fold.height if fold.falls else envelope < fold.height
    (leaves,) = np.nonzero(stays[:-1] & ~stays[1:])
    (late,) = np.nonzero(beyond[leaves + 1])
    if leaves.size == 0 or not beyond[-1] or (late.size == 0 and stays[-1]):
        return None
    at = int(leaves[late[0] if late.size else -1])
    ends = envelope[at : at + 2]
    share = (fold.height - ends[0]) / (ends[1] - ends[0])
    return float(hertz[at] + share * (hertz[at + 1] - hertz[at]))
