"""A checkpoint of the reference march: written, and read again."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.contact.memory import remembers
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from timedomain.contact.state import State
from timedomain.record.meters import meters
from timedomain.record.record import Meters
from timedomain.record.start import Start, at_rest, first_state


def checkpoint(
    state: State, meters: Meters, steps: int, step: float, stored: float
) -> Checkpoint:
    """Return where a march stands after so many steps [s].

    ``stored`` is the energy [J] that was stored at its start.
    """
    kept = [array.ravel() for array in _kept(state, meters)]
    memory = np.concatenate([[steps, stored, step], *kept])
    return Checkpoint(state.displacement.copy(), state.velocity.copy(), memory)


def restore(state: State, meters: Meters, end: Checkpoint) -> tuple[int, float, float]:
    """Put state and meters to where a march stood; return what else it kept.

    These are its number of steps, their length [s] and ``stored``.

    Raises
    ------
    ValueError
        If that march had other degrees of freedom or contacts.
    """
    arrays = (state.displacement, state.velocity, *_kept(state, meters))
    refill(arrays, np.concatenate([end.displacement, end.velocity, end.memory[3:]]))
    steps, stored, step = end.memory[:3]
    return int(steps), float(step), float(stored)


def refill(arrays: Sequence[NDArray[Any]], numbers: Array) -> None:
    """Write numbers of a checkpoint into the arrays of a march.

    Raises
    ------
    ValueError
        If they are the numbers of another problem.
    """
    if numbers.size != sum(array.size for array in arrays):
        raise ValueError(
            f"a march cannot go on from a state of {numbers.size} numbers: "
            "it must be one of the same problem"
        )
    cuts = np.cumsum([array.size for array in arrays])[:-1]
    for array, values in zip(arrays, np.split(numbers, cuts), strict=True):
        array[...] = values.reshape(array.shape)


def at_end(problem: Problem, end: Checkpoint) -> Start:
    """Return the motion at the end of a march, with what contacts remember.

    Those that remember are marched by the reference method alone, whose checkpoint
    holds their tractions; behind it may be that of a march with other steps.
    """
    if not remembers(problem.interface.points).any():
        return Start(end.displacement, end.velocity)
    state = first_state(problem, Dwell(1.0, 1.0), at_rest(problem))
    unread = meters(problem, problem.loads.T.copy(), state)
    own = 3 + sum(array.size for array in _kept(state, unread))
    restore(state, unread, replace(end, memory=end.memory[:own]))
    return Start(end.displacement, end.velocity, state.past[:, 1].copy())


def _kept(state: State, meters: Meters) -> tuple[Array, ...]:
    """Return what a step takes over from the one before, besides the motion."""
    return (*state[2:], meters.powers, meters.energies)
