"""The fast march: modes, contacts in few coordinates, a ladder of steps (§7)."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from microslip_mechanics.arrays import Array
from microslip_mechanics.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.segments import clock
from microslip_mechanics.time_history import Checkpoint, TimeHistory
from timedomain.coordinates import Contacts, Coordinates, Modes, modal_coordinates
from timedomain.energy_scale import least_energy, settled
from timedomain.ladder import DONE, FAILED, TICKS, climb
from timedomain.local_motion import empty_local
from timedomain.motion import (
    DRIFT,
    ITERATIONS,
    LARGEST_DRIFT,
    LENGTH,
    OTHER_WORK,
    REFERENCE,
    REJECTED,
    TICK,
    UNKEPT,
    Control,
    Motion,
    Trial,
)
from timedomain.options import IntegrationError, MarchOptions
from timedomain.record import FLOWS, STORES, row_length
from timedomain.schemes import MEAN_FORCE, SDIRK2, Scheme
from timedomain.start import (
    Start,
    first_state,
    force_scale,
    powers,
    refill,
    stored_energy,
)
from timedomain.state import State
from timedomain.tables import LEVELS, empty_tables, fill

NUMBERS = 5
"""that a row holds behind the energies"""
PER_CYCLE, CYCLED = 12, 3e-4
"""least number of steps in a cycle of the load, and the error that they make; it falls
with their fourth power"""
RESIDUAL = 1e-2
"""of contact forces, over the tolerance of one step"""
HOLD = 0.5
"""cycles of the load without a rough step before steps grow"""
ROUNDING = 1e-9
"""of a number of steps, relative"""
CANCELLED = 4.0
"""by which errors exceed their sum, whose signs cancel: at most that on eight rigs"""
SAFETY = 0.05
"""error of one step over the tolerance of the whole march"""


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
        self._force_scale = force_scale(problem, start)
        state = first_state(problem, history, start)
        self._control = self._controlled(state)
        self._stored_at_start = stored_energy(problem, state)
        modes, contacts = self._coordinates.modes, self._coordinates.contacts
        first, second = (empty_tables(each, modes, contacts) for each in schemes)
        self._tables = first, second
        self._trial = _trial(schemes, self._coordinates)
        inverse = self._coordinates.inverse
        reaction = _reaction(contacts, state.forces)
        self._motion = Motion(
            inverse @ state.displacement,
            inverse @ state.velocity,
            _coupled(modes, inverse, state),
            state.gaps,
            state.slips,
            state.forces,
            np.zeros_like(state.forces),
            np.stack([reaction, np.zeros_like(reaction)]),
            _relative(modes, inverse, state),
            powers(problem, history, state),
            np.zeros(len(FLOWS)),
            np.zeros(8),
            np.zeros(11, dtype=np.int64),
        )
        self._motion.numbers[LENGTH] = self._control.longest
        self._motion.numbers[REFERENCE] = self._control.least

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
        probes, points = len(self._problem.probes.names), self._problem.interface.count
        rows = np.empty((len(times), row_length(probes, points) + NUMBERS))
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

    def _controlled(self, state: State) -> Control:
        """Return step, ladder and tolerances."""
        options = self._options
        stride, longest, tolerance = options.store_every, self._step, 0.0
        lowest = min(LEVELS - 1, options.divisions)
        if options.tolerance is not None:
            row = self._step * stride
            steps = PER_CYCLE * max(1.0, CYCLED / options.tolerance) ** 0.25
            wanted = min(self._cycle() / steps, row)
            stride = 2 ** max(0, math.ceil(math.log2(row / wanted) - 1e-9))
            longest, tolerance = row / stride, SAFETY * options.tolerance
            lowest = LEVELS - 1
        floor = 1e-10 * self._force_scale
        residual = options.residual
        if tolerance > 0.0:
            residual = max(residual, RESIDUAL * tolerance)
        hold = int(TICKS * HOLD * self._cycle() / longest) if tolerance > 0.0 else 0
        modes, inverse = self._coordinates.modes, self._coordinates.inverse
        least = least_energy(modes, inverse, state, self._segments, longest)
        still = min(settled(self._segments), self._duration)
        tick = math.ceil(TICKS * (still / longest) * (1.0 - ROUNDING))
        return Control(
            longest, stride, tolerance, residual, floor, lowest, hold, least, tick
        )

    def _cycle(self) -> float:
        """Return the shortest cycle of the load [s], or the whole march."""
        begin = self._segments.begin
        edges = np.append(begin, self._duration)
        times = np.concatenate([edges, begin + 1e-9 * np.diff(edges)])
        fastest = float(np.abs(clock(self._segments, times)[:, 0]).max())
        return min(2.0 * np.pi / fastest, self._duration) if fastest else self._duration

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
        probes, contacts = self._problem.probes.names, self._problem.interface.names
        sizes = [len(probes), len(probes), len(contacts), 1, len(FLOWS) + len(STORES)]
        shown, moving, normal, power, energy, more = np.split(
            rows, np.cumsum(sizes), axis=1
        )
        difference = energy[:, FLOWS.index("friction")] - more[:, OTHER_WORK]
        history = TimeHistory(
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
            int(counts[ITERATIONS]),
            0 if self._options.tolerance else int(counts[REJECTED]),
            checkpoint=self._checkpoint(),
            work_difference=difference,
        )
        least = self._options.tolerance
        return history if least is None else _estimated(history, more, least)

    def _checkpoint(self) -> Checkpoint:
        shapes, motion = self._coordinates.shapes, self._motion
        kept = [np.ravel(array).astype(float) for array in motion]
        head = [self._stored_at_start, self._control.longest, self._control.tolerance]
        return Checkpoint(
            shapes @ motion.displacement,
            shapes @ motion.velocity,
            np.concatenate([head, *kept]),
        )


def _estimated(history: TimeHistory, more: Array, least: float) -> TimeHistory:
    """Return a history with estimated errors, none below the tolerance."""
    drift, unkept = np.abs(more[:, DRIFT]), more[:, UNKEPT]
    drift = CANCELLED * (drift + np.abs(history.work_difference)) + unkept
    lost = (more[:, LARGEST_DRIFT] + unkept) / more[:, REFERENCE]
    return replace(
        history,
        energy_error=np.maximum(drift, least * np.abs(history.of("friction"))),
        peak_error=np.maximum(lost, least),
    )


def _said(tolerance: float) -> str:
    """Return how accurate steps are, in words."""
    if tolerance == 0.0:
        return "without a tolerance"
    return f"with a tolerance of {tolerance / SAFETY:g}"


def _coupled(modes: Modes, inverse: Array, state: State) -> Array:
    """Return the damping force of the other modes, its rate and 0, (3, modes)."""
    if not modes.coupling.any():
        return np.zeros((3, 0))
    motion = np.stack([state.velocity, state.acceleration])
    return np.pad(motion @ inverse.T @ modes.coupling.T, ((0, 1), (0, 0)))


def _relative(modes: Modes, inverse: Array, state: State) -> Array:
    """Return y and ẏ, shape (2, rank)."""
    motion = np.stack([state.displacement, state.velocity], axis=1)
    return np.ascontiguousarray((modes.selection @ inverse @ motion).T)


def _reaction(contacts: Contacts, forces: Array) -> Array:
    """Return φ from the forces of the points."""
    reaction = np.zeros(int((contacts.first + contacts.width).max(initial=0)))
    for first, width, basis, force in zip(
        contacts.first, contacts.width, contacts.basis, forces, strict=True
    ):
        reaction[first : first + width] += force @ basis[:, :width]
    return reaction


def _trial(schemes: tuple[Scheme, Scheme], coordinates: Coordinates) -> Trial:
    """Return workspace for a step."""
    modes, points = coordinates.modes, coordinates.contacts.first.size
    count, rank = modes.stiffness.size, len(modes.selection)
    stages = 1 + max(scheme.stages for scheme in schemes)
    return Trial(
        empty_local(rank, points),
        np.zeros(count),
        np.zeros(count),
        np.zeros((stages, count)),
        np.zeros(count),
        np.zeros((2, rank)),
        np.zeros((stages, len(FLOWS))),
        np.zeros(len(modes.loads)),
        np.zeros((points, 3)),
        np.zeros(rank),
        np.zeros(4),
        np.zeros(count),
        np.zeros(count),
        np.zeros(points),
        np.zeros((3, count if modes.coupling.any() else 0)),
    )
