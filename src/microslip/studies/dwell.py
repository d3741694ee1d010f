"""A sine of one frequency until the motion repeats itself."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from microslip.scenes.experiments import March
from microslip.studies.march_size import demand_end
from microslip_mechanics.arrays import Array
from microslip_mechanics.loads.excitation import Dwell
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.time_history import TimeHistory
from microslip_mechanics.static import static_equilibrium
from timedomain.integrate import MarchOptions, integrate
from timedomain.record.driftless import driftless, undragged_motions
from timedomain.record.start import Start
from timedomain.step_doubling import rows_between

ROWS = 60
"""per period at least, if the steps are not longer"""
REMEDY = "give a longer march.time_step, a higher --frequency or fewer --most-periods"
WINDOW = 32
"""periods over which a transient is seen to fade: beats of modes should be shorter"""

MULTIPLES = 12
"""periods after which a motion is seen to repeat itself, at most"""
ALIKE = 1e-4
"""of what a period changes: below it a motion repeats itself"""


@dataclass(frozen=True, slots=True)
class Period:
    """A period of a dwell."""

    history: TimeHistory
    distance: float
    """from the steady state, estimated, over the motion's size; inf while unknown"""


def dwelling(
    problem: Problem, frequency: float, march: March, *, tolerance: float, most: int
) -> Iterator[Period]:
    """Yield periods from rest under the preload until the motion is steady.

    Parameters
    ----------
    problem, march
        What is marched, and in which steps; a period is a whole number of them.
    frequency
        Of the drive [rad/s].
    tolerance
        The dwell ends when the estimated distance from the steady state is below it.
    most
        Periods after which it ends in any case.

    The period map moves the state by d_k = |x_k − x_{k−1}| in the norm of energy. While
    the d fade by a factor of ρ in each period, d_k ρ/(1−ρ) is left to go. As modes
    that fade together beat, d_k and ρ are taken from the largest d of each window;
    where two of them account for all of d_k, less is left.

    Raises
    ------
    SceneError
        If it would not end.
    """
    period = 2.0 * math.pi / frequency
    loads = Dwell(frequency, most * period)
    options = _options(loads, march, period)
    rest = static_equilibrium(problem).displacement
    ruler = _Ruler(problem, frequency, rest)
    start = Start(rest, driftless(problem, replace(loads, duration=period)))
    blocks = integrate(problem, loads, options, start=start, block=period)
    for block in blocks:
        told = np.full(len(block.time), frequency), np.ones(len(block.time))
        distance = ruler.distance(block.checkpoint)
        yield Period(replace(block, frequency=told[0], level=told[1]), distance)
        if distance <= tolerance:
            return


def _options(loads: Dwell, march: March, period: float) -> MarchOptions:
    """Return steps and rows of which a whole number fills a period."""
    dense = period / (ROWS * march.time_step)
    stride = max(1, int(min(march.store_every, dense)))
    options = MarchOptions(march.time_step, stride, estimate=True)
    demand_end(loads, options, REMEDY, block=period)
    group = rows_between(options)
    rows = group * math.ceil(period / (march.time_step * stride * group))
    return replace(options, time_step=period / (rows * stride))


class _Ruler:
    """Measures how far a motion is from repeating itself."""

    def __init__(self, problem: Problem, frequency: float, rest: Array) -> None:
        mass = problem.structure.dense.mass
        self._root = np.linalg.cholesky(mass).T
        self._unheld = undragged_motions(problem)
        self._momenta = self._unheld.T @ mass
        self._frequency, self._rest = frequency, rest
        self._before = np.zeros(2 * rest.size)
        self._changes: list[Array] = []
        self._moved: list[float] = []

    def distance(self, state: Checkpoint | None) -> float:
        """Return the estimated distance from the steady state, relative."""
        if state is None:
            return math.inf
        moved = state.displacement - self._rest
        moved -= self._unheld @ (self._momenta @ moved)  # where it is does not matter
        place = self._frequency * (self._root @ moved)
        here = np.concatenate([place, self._root @ state.velocity])
        self._changes = [*self._changes[-2:], here - self._before]
        self._moved.append(float(np.linalg.norm(self._changes[-1])))
        self._before = here
        if max(self._moved) == 0.0:
            return 0.0
        recent, before = self._moved[-WINDOW:], self._moved[-2 * WINDOW : -WINDOW]
        if len(before) < WINDOW or not max(recent) < max(before):
            return math.inf
        fade = (max(recent) / max(before)) ** (1.0 / WINDOW)
        if fade >= 1.0:  # by rounding: what is left of the motion jitters
            return math.inf
        alike = fade / (1.0 - fade)
        left = min(max(recent) * alike, _left(self._changes, alike))
        return float(left / np.linalg.norm(here))


def _left(changes: Sequence[Array], alike: float) -> float:
    """Return how far a motion has yet to go after three changes.

    A pair of modes that fade and beat changes it by d_k = a d_{k−1} + b d_{k−2}, and
    all changes to come add up to (a d_k + b (d_k + d_{k−1})) / (1 − a − b). What the
    best such numbers leave of the third change counts ``alike`` times, as if it faded
    without a beat.
    """
    first, second, third = changes
    pair = np.stack([second, first], axis=1)
    (a, b), *_ = np.linalg.lstsq(pair, third, rcond=None)
    unlike = third - pair @ (a, b)
    if not a + b < 1.0:
        return math.inf
    rest = (a * third + b * (third + second)) / (1.0 - a - b)
    return float(np.linalg.norm(rest) + alike * np.linalg.norm(unlike))


def repeats(history: TimeHistory, periods: int) -> int:
    """Return after how many periods, more than one, the end of a dwell repeats itself.

    It is 0 if it does not, and for motions that are not steady alone.
    """
    rows = len(history.time) // periods
    speed = history.velocity / history.frequency[:, None]
    ends = np.hstack([history.displacement, speed])[rows - 1 :: rows]
    last = ends[-3 * MULTIPLES :]
    step = np.abs(np.diff(last, axis=0)).max(initial=0.0)
    if len(last) < 3 * MULTIPLES or step == 0.0:
        return 0
    for many in range(2, MULTIPLES + 1):
        if np.abs(last[many:] - last[:-many]).max() <= ALIKE * step:
            return many
    return 0


def amplitudes(history: TimeHistory, frequency: float) -> Array:
    """Return the first harmonic of each probe over the last period [m]."""
    begin = history.time[-1] - 2.0 * math.pi / frequency
    last = history.time > begin * (1.0 + 1e-12)
    waves = np.exp(-1j * frequency * history.time[last])[:, None]
    found: Array = np.abs(2.0 * (waves * history.displacement[last]).mean(axis=0))
    return found
