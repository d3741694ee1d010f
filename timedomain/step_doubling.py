"""A march beside one of longer steps: the difference tells its error (theory, §7.2)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import LoadHistory
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.fast.energy_scale import settled
from timedomain.fast.fast import FastMarch
from timedomain.options import MOST_DIVISIONS, MarchOptions
from timedomain.record.start import Start
from timedomain.reference.reference import ReferenceMarch

CAUTION = 1.5
"""estimate over difference: where friction turns over within a step errors are no
power of the step, and both marches may by chance be wrong alike"""
LOOSER = 8.0
"""times the tolerance, which makes steps twice as long: they err by their cube"""
LOOSEST = 0.99


class StepDoubling:
    """A march that also takes steps of twice the length, and tells what they change.

    Estimates are the largest difference so far, of friction's energy and of half the
    way between a probe's extremes where neither march widens it: while one does, phases
    differ more than amplitudes. Nothing is divided by 2ᵖ - 1: where friction turns over
    within a step the order p is not that of the scheme, and differences have signs.
    With a tolerance the other march has :data:`LOOSER` times as much, and the march's
    own estimates stay where they are larger: they sum up errors of steps, and do not
    see how these grow where motions that begin alike part.

    Parameters
    ----------
    method
        The march's class.
    steps
        Its number of steps; rows that end at an odd one must be even in number.
    """

    def __init__(
        self,
        method: type[FastMarch] | type[ReferenceMarch],
        problem: Problem,
        history: LoadHistory,
        options: MarchOptions,
        steps: int,
        start: Start,
    ) -> None:
        self._every = rows_between(options)
        self._ratio = 2 if options.tolerance is None else 1
        self._march = method(problem, history, options, steps, start)
        self._other = method(
            problem, history, _rougher(options), steps // self._ratio, start
        )
        self._still = min(settled(history.segments()), history.duration)
        rest = problem.probes.rows @ start.displacement
        self._extremes: Array = np.array([[rest, rest], [-rest, -rest]])
        self._away: Array = np.zeros(2)  # largest so far, of swing [m] and energy [J]

    def resume(self, end: Checkpoint) -> int:
        """Go back to the end of a block; return the steps until there.

        Raises
        ------
        ValueError
            If that march was one of another problem, with other steps, or without a
            march of twice its steps.
        """
        dofs, kept = end.displacement.size, self._extremes.size + self._away.size
        own, odd = divmod(end.memory.size - 2 * dofs - kept, 2)
        if odd or own < 0:
            raise ValueError(
                "a march without one of longer steps beside it cannot go on with an "
                "estimate of its error: march anew"
            )
        cuts = np.cumsum([own, dofs, dofs, own, self._extremes.size])
        first, moved, moving, second, extremes, away = np.split(end.memory, cuts)
        done = self._march.resume(replace(end, memory=first))
        self._other.resume(Checkpoint(moved, moving, second))
        self._extremes = extremes.reshape(self._extremes.shape)
        self._away = away
        return done

    def block(self, first: int, count: int) -> TimeHistory:
        """March ``count`` steps from step ``first``, and longer ones beside."""
        fine = self._march.block(first, count)
        coarse = self._other.block(first // self._ratio, count // self._ratio)
        shared = slice(self._every - 1, None, self._every)
        away = CAUTION * np.abs(fine.of("friction")[shared] - coarse.of("friction"))
        moved = np.stack([fine.displacement[shared], coarse.displacement])
        energy = np.repeat(_largest_so_far(away, self._away[1:]), self._every)
        peak = np.repeat(self._peak_error(moved, coarse.time), self._every)
        if fine.energy_error.size:
            energy = np.maximum(energy, fine.energy_error)
            peak = np.maximum(peak, fine.peak_error)
        return replace(
            fine,
            iterations=fine.iterations + coarse.iterations,
            energy_error=energy,
            peak_error=peak,
            checkpoint=self._checkpoint(fine.checkpoint, coarse.checkpoint),
        )

    def _peak_error(self, moved: Array, time: Array) -> Array:
        """Return the relative error of the largest amplitude, shape (rows,).

        What a growing preload alone has moved is forgotten when it has grown.
        """
        place = int(np.searchsorted(time, self._still, side="right"))
        before = self._peaks(moved[:, :place])
        if place and time[-1] >= self._still:
            here = moved[:, place - 1]
            self._extremes = np.stack([here, -here])
            self._away[0] = 0.0
        return np.concatenate([before, self._peaks(moved[:, place:])])

    def _peaks(self, moved: Array) -> Array:
        """Return it over rows without such a change."""
        if moved.shape[1] == 0:
            return np.zeros(0)
        rows = np.stack([moved, -moved])
        rows = np.concatenate([self._extremes[:, :, None], rows], axis=2)
        extremes = np.maximum.accumulate(rows, axis=2)
        widens = (np.diff(extremes, axis=2) > 0.0).any(axis=(0, 1))
        self._extremes = extremes[:, :, -1]
        fine, coarse = 0.5 * extremes[:, :, 1:].sum(axis=0)
        away = np.where(widens, 0.0, CAUTION * np.abs(fine - coarse))
        error = _largest_so_far(away.max(axis=-1, initial=0.0), self._away[:1])
        size = fine.max(axis=-1, initial=0.0)
        return np.asarray(error / np.where(size > 0.0, size, 1.0))

    def _checkpoint(
        self, fine: Checkpoint | None, coarse: Checkpoint | None
    ) -> Checkpoint | None:
        """Return where both marches stand, and the differences so far."""
        if fine is None or coarse is None:
            return None
        parts = (
            fine.memory,
            coarse.displacement,
            coarse.velocity,
            coarse.memory,
            self._extremes.ravel(),
            self._away,
        )
        return replace(fine, memory=np.concatenate(parts))


def rows_between(options: MarchOptions) -> int:
    """Return in how many stored rows there are whole steps of both marches."""
    return 1 if options.tolerance is not None or options.store_every % 2 == 0 else 2


def _rougher(options: MarchOptions) -> MarchOptions:
    """Return those of the march beside, whose rows are those both share."""
    if options.tolerance is not None:
        return replace(options, tolerance=min(LOOSEST, LOOSER * options.tolerance))
    return replace(
        options,
        store_every=options.store_every * rows_between(options) // 2,
        divisions=min(MOST_DIVISIONS, options.divisions + 1),
    )


def _largest_so_far(values: Array, before: Array) -> Array:
    """Return the largest value up to each, and keep the last in ``before``."""
    largest: Array = np.maximum(np.maximum.accumulate(values), before)
    before[:] = largest[-1]
    return largest
