"""The public function: a problem and a load history to blocks of a time history."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.errors import MicroslipError
from microslip_mechanics.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.time_history import Checkpoint, TimeHistory
from timedomain.newmark import Operators, march
from timedomain.record import FLOWS, STORES, accumulate, row_length, store
from timedomain.start import (
    Start,
    at_rest,
    checkpoint,
    first_state,
    meters,
    restore,
    stored_energy,
)

MOST_DIVISIONS = 20
"""a step in a million parts"""


class IntegrationError(MicroslipError):
    """A time step that does not converge, however short."""


@dataclass(frozen=True, slots=True)
class MarchOptions:
    """Step size, storage and accuracy of a march."""

    time_step: float = 2.5e-5
    """longest step [s]; the last step ends exactly at the history's end"""
    store_every: int = 10
    """steps per stored row"""
    tolerance: float = 1e-9
    """of the contact forces' residual over the relative acceleration"""
    divisions: int = 10
    """how often a step that does not converge is halved"""

    def __post_init__(self) -> None:
        """Check that each option is a number that a march can use."""
        if not 0.0 < self.time_step < math.inf:
            raise ValueError(
                f"time step {self.time_step:g} s: give a positive finite one"
            )
        if not 1 <= self.store_every < math.inf:
            raise ValueError(f"store every {self.store_every} steps: give at least 1")
        if not 0.0 < self.tolerance < 1.0:
            raise ValueError(
                f"tolerance {self.tolerance:g}: give one between 0 and 1, such as 1e-9"
            )
        if not 1 <= self.divisions <= MOST_DIVISIONS:
            raise ValueError(
                f"{self.divisions} divisions of a step: give 1 to {MOST_DIVISIONS}"
            )


def integrate(
    problem: Problem,
    history: LoadHistory,
    options: MarchOptions,
    *,
    start: Start | Checkpoint | None = None,
    block: float = 0.1,
) -> Iterator[TimeHistory]:
    """Yield the response to a load history, block by block.

    Parameters
    ----------
    problem
        What is integrated.
    history
        Factors of preload and drive over time.
    options
        Step and accuracy.
    start
        Initial displacement and velocity; all at rest and without load if left out.
        From the checkpoint of a block of the same march, the rest of it is yielded.
    block
        Length of a block [s].

    Raises
    ------
    ValueError
        If the block has no length, the structure is sparse, or forces have phases.
    IntegrationError
        If a step does not converge even when it is divided; what was yielded stays.
    """
    if not 0.0 < block < math.inf:
        raise ValueError(f"block of {block:g} s: give a positive finite length")
    if not problem.in_phase:
        raise ValueError(
            "the forces have different phases: a march knows one sine for all of "
            "them; give them one phase, or use harmonic balance alone"
        )
    steps = max(1, int(np.ceil(history.duration / options.time_step - 1e-9)))
    stride = min(options.store_every, steps)
    rows = -(-steps // stride)
    options = replace(options, store_every=stride)
    begin = (
        at_rest(problem) if start is None or isinstance(start, Checkpoint) else start
    )
    marching = _March(problem, history, options, rows * stride, begin)
    done = marching.resume(start) // stride if isinstance(start, Checkpoint) else 0
    per_block = max(1, round(block * rows / history.duration))
    for first in range(done, rows, per_block):
        count = min(per_block, rows - first)
        yield marching.block(first * stride, count * stride)


class _March:
    """A march under way: operators, state and meters."""

    def __init__(
        self,
        problem: Problem,
        history: LoadHistory,
        options: MarchOptions,
        steps: int,
        start: Start,
    ) -> None:
        self._problem, self._history = problem, history
        self._options, self._steps = options, steps
        self._step = history.duration / steps
        self._shapes = np.stack([problem.preload, problem.drive.real], axis=1)
        self._operators = _operators(problem, self._shapes, self._step)
        self._state = first_state(problem, history, start)
        self._meters = meters(problem, self._shapes)
        self._stored_at_start = stored_energy(problem, self._state)
        # the powers at time zero, for the first trapezoid
        self._measure(history.factors(np.zeros(1))[0], 0.0)

    def resume(self, end: Checkpoint) -> int:
        """Go back to the end of a block; return the steps until there."""
        steps, self._stored_at_start = restore(self._state, self._meters, end)
        return steps

    def block(self, first: int, count: int) -> TimeHistory:
        """March ``count`` steps from step ``first``; divide those that fail."""
        stride, points = self._options.store_every, self._problem.interface.points
        probes = len(self._problem.probes.names)
        rows = np.empty((count // stride, row_length(probes, len(points.load))))
        times = self._times(first + np.arange(1.0, count + 1.0))
        factors = self._history.factors(times)
        done, iterations, divided = 0, 0, 0
        while True:
            done, taken = march(
                self._operators,
                points,
                self._state,
                self._meters,
                factors,
                rows,
                done,
                self._options.tolerance,
            )
            iterations += taken
            if done == count:
                break
            iterations += self._divide(first + done)
            divided, done = divided + 1, done + 1
            if done % stride == 0:
                store(self._meters, points, self._state, rows[done // stride - 1])
        end = checkpoint(
            self._state, self._meters, first + count, self._stored_at_start
        )
        return self._table(times[stride - 1 :: stride], rows, iterations, divided, end)

    def _divide(self, step: int) -> int:
        """Take step number ``step`` in parts; return Newton's iterations."""
        points = self._problem.interface.points
        nothing = np.empty((1, row_length(len(self._meters.probes), len(points.load))))
        before = [array.copy() for array in (*self._state, *self._meters)]
        for halvings in range(1, self._options.divisions + 1):
            parts = 2**halvings
            times = self._times(step + np.arange(1.0, parts + 1.0) / parts)
            operators = _operators(self._problem, self._shapes, self._step / parts)
            done, iterations = march(
                operators,
                points,
                self._state,
                self._meters,
                self._history.factors(times),
                nothing,
                0,
                self._options.tolerance,
            )
            if done == parts:
                return iterations
            for array, old in zip((*self._state, *self._meters), before, strict=True):
                array[:] = old
        raise IntegrationError(
            f"the step at t = {step * self._step:.6g} s does not converge, even "
            f"in {parts} parts: "
            "give a shorter time step, a larger threshold velocity or a softer contact"
        )

    def _times(self, steps: Array) -> Array:
        """Return the times after so many steps; the last is exactly the duration."""
        return self._history.duration * (steps / self._steps)

    def _measure(self, factors: Array, step: float) -> None:
        points = self._problem.interface.points
        accumulate(self._meters, points, self._state, factors, step)

    def _table(
        self,
        times: Array,
        rows: Array,
        iterations: int,
        divided: int,
        end: Checkpoint,
    ) -> TimeHistory:
        probes, contacts = self._problem.probes.names, self._problem.interface.names
        cuts = np.cumsum([len(probes), len(probes), len(contacts), 1])
        shown, moving, normal, power, energy = np.split(rows, cuts, axis=1)
        return TimeHistory(
            times,
            probes,
            shown,
            moving,
            contacts,
            normal,
            power[:, 0],
            (*FLOWS, *STORES),
            energy,
            self._stored_at_start,
            self._step,
            iterations,
            divided,
            checkpoint=end,
        )


def _operators(problem: Problem, shapes: Array, step: float) -> Operators:
    """Return the matrices of average acceleration (theory, eqs. 22–23)."""
    structure = problem.structure.dense
    basis, selection = problem.interface.relative_motion()
    half = 0.5 * step
    effective = (
        structure.mass + half * structure.damping + half**2 * structure.stiffness
    )
    inverse = np.linalg.inv(effective)
    contact = inverse @ selection.T
    return Operators(
        step,
        -inverse @ np.hstack([structure.stiffness, structure.damping]),
        inverse @ shapes,
        contact,
        selection @ contact,
        selection,
        basis,
    )
