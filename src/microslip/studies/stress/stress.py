"""Stiff and extreme cases by both solvers: what agrees, what ends with a cause."""

from __future__ import annotations

import contextlib
import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import islice

from hbm.errors import ContinuationError
from microslip.errors import EXPECTED, one_line
from microslip.scenes.rigs import problem_of
from microslip.scenes.scene_file import load_scene
from microslip.studies.bounded import bounded
from microslip.studies.clock import Clock, OutOfTimeError
from microslip.studies.curve import trace_curve
from microslip.studies.stress.budget import Budget
from microslip.studies.stress.case import Case
from microslip.studies.stress.curve import Drawn, drawn
from microslip.studies.stress.finding import Finding, Outcome, Tried, causes
from microslip.studies.stress.refusals import refusals
from microslip.studies.stress.witness import from_rest, witnessed
from microslip.studies.worker import Ended
from timedomain.shooting.period_map import BLOCK, PeriodMap
from timedomain.shooting.whole_orbit import whole_orbit
from timedomain.verify import march_periods

TOLERANCE = "curve.tolerance=5e-3"
"""half of what is asked, unless the curve is told otherwise"""


def tried(
    scene: str,
    overrides: Sequence[str],
    chosen: Sequence[Case],
    budget: Budget,
) -> Iterator[Tried]:
    """Yield how each case goes, as they end; none takes longer than its share.

    A case whose time is over, or whose process dies, keeps what was found of it.
    """
    task = partial(_studied, scene, tuple(overrides))
    prepare = partial(_prepare, scene, tuple(overrides))
    for ended in bounded(
        task,
        chosen,
        seconds=budget.share,
        processes=budget.processes,
        prepare=prepare,
    ):
        yield Tried(ended.item, _last(ended), ended.seconds)


def _last(ended: Ended[Case]) -> Finding:
    finding = ended.result or Finding()
    if not ended.cause:
        return finding
    # an exception that no command expects, or a process that died, is a defect
    late = ended.cause.startswith("out of time")
    outcome = Outcome.HONEST if late else Outcome.DISAGREES
    return replace(finding, outcome=outcome, cause=causes(ended.cause, finding.cause))


def _prepare(scene: str, overrides: tuple[str, ...]) -> None:
    """Have all machine code made, as far as the scene lets it.

    The cases themselves tell what the scene does not allow.
    """
    with contextlib.suppress(*EXPECTED):
        _warmed(scene, overrides)


def _warmed(scene: str, overrides: tuple[str, ...]) -> None:
    """Make points of the scene's curve, roughly, an orbit and a march."""
    rough = ("curve.harmonics=3", "curve.samples=64")
    loaded = load_scene(scene, (*overrides, *rough))
    problem = problem_of(loaded)
    traced = trace_curve(problem, loaded.curve, lambda points: islice(points, 2))
    first = traced.responses[0]
    deque(march_periods(problem, first, periods=1, steps_per_period=60), maxlen=0)
    whole_orbit(PeriodMap.of(problem, first.frequency, 2 * BLOCK), first)
    deque(witnessed(problem, Drawn(traced), Clock(math.inf)), maxlen=0)


def _studied(
    scene: str, overrides: tuple[str, ...], case: Case, seconds: float
) -> Iterator[Finding]:
    """Yield what is found of a case in its time, better and better."""
    if case.refusals:
        yield from refusals(scene, overrides, case)
        return
    clock = Clock(seconds)
    own = scene, (TOLERANCE, *overrides, *case.overrides)
    if case.scene is not None:
        own = case.scene, (TOLERANCE, *case.overrides)
    try:
        loaded = load_scene(*own)
        problem = problem_of(loaded)
        made = drawn(problem, loaded.curve, clock)
    except (*EXPECTED, OutOfTimeError) as error:
        told = f"harmonic balance: {one_line(error)}"
        yield Finding(cause=told)
        if isinstance(error, (ContinuationError, OutOfTimeError)):
            also = from_rest(problem, loaded, clock)
            yield Finding(cause=causes(told, also))
        return
    yield from witnessed(problem, made, clock)
