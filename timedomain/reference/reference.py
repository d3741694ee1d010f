"""The reference march: average acceleration with a fixed step (theory, eqs. 21–25)."""

from __future__ import annotations

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.loads.segments import factors_over
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.contact.operators import Operators, step_operators
from timedomain.options import IntegrationError, MarchOptions
from timedomain.record.checkpoint import checkpoint, restore
from timedomain.record.meters import meters, stored_energy
from timedomain.record.record import accumulate, row_length, store
from timedomain.record.start import Start, first_state
from timedomain.record.stored_history import stored_history
from timedomain.reference.newmark import march
from timedomain.reference.rigid_points import sliders
from timedomain.reference.set_valued import march_sliders

SAME = 1e-9
"""relative difference of steps that rounding makes"""


class ReferenceMarch:
    """A march by average acceleration under way: operators, state and meters."""

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
        self._shapes = problem.loads.T.copy()
        self._operators = step_operators(problem, self._shapes, self._step)
        self._sliders = sliders(problem)
        self._state = first_state(problem, history, start, self._step)
        self._meters = meters(problem, self._shapes, self._state)
        self._stored_at_start = stored_energy(problem, self._state)
        # the powers at time zero, for the first trapezoid
        begin = self._factors(np.zeros(1))[0]
        accumulate(self._meters, problem.interface.points, self._state, begin, 0.0)

    def resume(self, end: Checkpoint) -> int:
        """Go back to the end of a block; return the steps until there.

        Raises
        ------
        ValueError
            If that march was one of another problem or with other steps.
        """
        steps, step, stored = restore(self._state, self._meters, end)
        if abs(step - self._step) > SAME * step:
            raise ValueError(
                f"a march with steps of {step:g} s cannot go on with steps of "
                f"{self._step:g} s: give the same time step"
            )
        self._stored_at_start = stored
        return steps

    def block(self, first: int, count: int) -> TimeHistory:
        """March ``count`` steps from step ``first``; divide those that fail."""
        stride, points = self._options.store_every, self._problem.interface.points
        probes = len(self._problem.probes.names)
        rows = np.empty((count // stride, row_length(probes, len(points.load))))
        times = self._times(first + np.arange(1.0, count + 1.0))
        factors = self._factors(times)
        done, iterations, divided = 0, 0, 0
        while True:
            done, taken = self._marched(self._operators, factors, rows, done)
            iterations += taken
            if done == count:
                break
            iterations += self._divide(first + done)
            divided, done = divided + 1, done + 1
            if done % stride == 0:
                store(self._meters, points, self._state, rows[done // stride - 1])
        return stored_history(
            self._problem,
            times[stride - 1 :: stride],
            rows,
            stored_at_start=self._stored_at_start,
            step=self._step,
            iterations=iterations,
            divided=divided,
            checkpoint=self._checkpoint(first + count),
        )

    def _checkpoint(self, steps: int) -> Checkpoint:
        """Return the end of a block, so many steps from the start of the march."""
        return checkpoint(
            self._state, self._meters, steps, self._step, self._stored_at_start
        )

    def _marched(
        self, operators: Operators, factors: Array, rows: Array, first: int
    ) -> tuple[int, int]:
        """March until a step fails; return the steps done and Newton's iterations."""
        points, residual = self._problem.interface.points, self._options.residual
        state, meters = self._state, self._meters
        if self._sliders.points.size == 0:
            return march(
                operators, points, state, meters, factors, rows, first, residual
            )
        return march_sliders(
            operators, self._sliders, points, state, meters, factors, rows, first,
            residual,
        )  # fmt: skip

    def _divide(self, step: int) -> int:
        """Take step number ``step`` in parts; return Newton's iterations."""
        points = self._problem.interface.points
        nothing = np.empty((1, row_length(len(self._meters.probes), len(points.load))))
        before = [array.copy() for array in (*self._state, *self._meters)]
        for halvings in range(1, self._options.divisions + 1):
            parts = 2**halvings
            times = self._times(step + np.arange(1.0, parts + 1.0) / parts)
            operators = step_operators(self._problem, self._shapes, self._step / parts)
            factors = self._factors(times)
            done, iterations = self._marched(operators, factors, nothing, 0)
            if done == parts:
                return iterations
            for array, old in zip((*self._state, *self._meters), before, strict=True):
                array[:] = old
        raise IntegrationError(
            f"the step at t = {step * self._step:.6g} s does not converge, even "
            f"in {parts} parts: "
            "give a shorter time step, a larger threshold velocity or a softer contact"
        )

    def _factors(self, times: Array) -> Array:
        return factors_over(self._history.segments(), times, self._shapes.shape[1])

    def _times(self, steps: Array) -> Array:
        """Return the times after so many steps; the last is exactly the duration."""
        return self._history.duration * (steps / self._steps)
