"""The fast march: modes, contacts in few coordinates, a ladder of steps (§7.2)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.fast.coordinates import modal_coordinates
from timedomain.fast.fast_control import SAFETY, fast_control
from timedomain.fast.fast_history import empty_rows, fast_history
from timedomain.fast.first_motion import first_motion
from timedomain.fast.ladder import DONE, FAILED, TICKS, climb
from timedomain.fast.motion import ITERATIONS, REJECTED, TICK, empty_trial
from timedomain.fast.schemes import MEAN_FORCE, SDIRK2, Scheme
from timedomain.fast.tables import LEVELS, empty_tables, fill
from timedomain.options import IntegrationError, MarchOptions
from timedomain.record.checkpoint import refill
from timedomain.record.meters import stored_energy
from timedomain.record.start import Start, first_state, force_scale


class FastMarch:
    """A march by the fast method under way."""

    def __init__(
        self,
        problem: Problem,
        history: LoadHistory,
        options: MarchOptions,
        steps: int,
        start: Start,
        *,
        schemes: tuple[Scheme, Scheme] = (MEAN_FORCE, SDIRK2),
    ) -> None:
        self._problem, self._options, self._schemes = problem, options, schemes
        self._duration, self._steps = history.duration, steps
        self._step = history.duration / steps
        self._coordinates = modal_coordinates(problem)
        self._segments = history.segments()
        state = first_state(problem, history, start)
        self._control = fast_control(
            options,
            self._segments,
            coordinates=self._coordinates,
            state=state,
            duration=self._duration,
            step=self._step,
            force_scale=force_scale(problem, start),
        )
        self._stored_at_start = stored_energy(problem, state)
        modes, contacts = self._coordinates.modes, self._coordinates.contacts
        first, second = (empty_tables(each, modes, contacts) for each in schemes)
        self._tables = first, second
        self._trial = empty_trial(schemes, self._coordinates)
        self._motion = first_motion(
            problem, history, self._coordinates, state, self._control
        )

    def resume(self, end: Checkpoint) -> int:
        """Go back to the end of a block; return the steps until there.

        Raises
        ------
        ValueError
            If that march was one of another problem or with other steps.
        """
        stored, longest, tolerance = (float(each) for each in end.memory[:3])
        refill(self._motion, end.memory[3:])
        self._stored_at_start = stored
        if tolerance != self._control.tolerance:
            here = _said(self._control.tolerance)
            raise ValueError(
                f"a march {_said(tolerance)} cannot go on {here}: give what it had"
            )
        if longest != self._control.longest:
            raise ValueError(
                f"a march with steps of {longest:g} s cannot go on with steps of "
                f"{self._control.longest:g} s: give the same time step"
            )
        rows = self._motion.counts[TICK] // (self._control.stride * TICKS)
        return int(rows) * self._options.store_every

    def block(self, first: int, count: int) -> TimeHistory:
        """March ``count`` steps from step ``first``, numbered in nominal steps."""
        stride, counts = self._options.store_every, self._motion.counts
        numbers = 1 + first // stride + np.arange(count // stride)
        times = self._duration * (numbers * stride / self._steps)
        rows = empty_rows(self._problem, len(times))
        before, done, status = counts.copy(), 0, FAILED
        modes, contacts = self._coordinates.modes, self._coordinates.contacts
        while status != DONE:
            done, status = climb(
                self._control,
                modes,
                contacts,
                self._tables,
                self._segments,
                self._motion,
                self._trial,
                rows,
                done,
            )
            if status == FAILED:
                raise self._failure()
            if status >= 0:
                self._fill(*divmod(status, LEVELS))
        if not np.isfinite(rows).all():
            raise IntegrationError(
                f"numbers overflow before t = {times[-1]:.6g} s: give a structure, "
                "contacts and loads of realistic sizes"
            )
        return self._table(times, rows, counts - before)

    def _fill(self, place: int, level: int) -> None:
        """Make the tables of a scheme for the steps of a level."""
        fill(
            self._tables[place],
            self._schemes[place],
            self._coordinates.modes,
            self._coordinates.contacts,
            level=level,
            step=self._control.longest / 2.0**level,
        )

    def _failure(self) -> IntegrationError:
        tick = self._motion.counts[TICK]
        return IntegrationError(
            f"the step at t = {self._control.longest * tick / TICKS:.6g} s does not "
            f"converge, even in {2**self._control.lowest} parts: "
            "give a shorter time step, a larger threshold velocity, a softer contact "
            "or less damping between modes"
        )

    def _table(
        self, times: Array, rows: Array, counts: NDArray[np.int64]
    ) -> TimeHistory:
        """Return the stored rows as a history; ``counts`` is how many were made."""
        return fast_history(
            self._problem,
            times,
            rows,
            stored_at_start=self._stored_at_start,
            step=self._step,
            iterations=int(counts[ITERATIONS]),
            rejected=int(counts[REJECTED]),
            tolerance=self._options.tolerance,
            checkpoint=self._checkpoint(),
        )

    def _checkpoint(self) -> Checkpoint:
        shapes, motion = self._coordinates.shapes, self._motion
        kept = [np.ravel(array).astype(float) for array in motion]
        head = [self._stored_at_start, self._control.longest, self._control.tolerance]
        return Checkpoint(
            shapes @ motion.displacement,
            shapes @ motion.velocity,
            np.concatenate([head, *kept]),
        )


def _said(tolerance: float) -> str:
    """Return how accurate steps are, in words."""
    if tolerance == 0.0:
        return "without a tolerance"
    return f"with a tolerance of {tolerance / SAFETY:g}"
