"""The swept sine of a scene, as far as it was marched."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from typing import Any

from microslip.interruption import unmasked
from microslip.progress import Watch
from microslip.scenes.experiments import March, Sweep
from microslip.studies.march_size import demand_end
from microslip_mechanics.loads.excitation import LoadHistory, SweptSine
from microslip_mechanics.loads.segments import clock
from microslip_mechanics.problem import Problem
from microslip_mechanics.results.checkpoint import Checkpoint
from microslip_mechanics.results.cycle_rows import enveloped, parted
from microslip_mechanics.results.envelope import Envelope
from microslip_mechanics.results.joined import joined
from microslip_mechanics.results.time_history import TimeHistory
from timedomain.integrate import IntegrationError, MarchOptions, integrate
from timedomain.record.start import loaded

REMEDY = (
    "give a longer march.time_step, a larger march.store_every, a shorter sweep or "
    "force, or a lower sweep.highest"
)


def marched(
    problem: Problem,
    loads: LoadHistory,
    march: March,
    *,
    envelope: bool = False,
    end: Checkpoint | None = None,
    tolerance: float | None = None,
    estimate: bool = True,
) -> Iterator[TimeHistory | Envelope]:
    """Yield the march of a scene block by block, as rows or as their envelope.

    It begins at rest; ``end`` is where a stopped march of the same scene and kind goes
    on. Steps are those of the scene, or follow from a ``tolerance``. Errors are
    estimated by a march of longer steps beside unless ``estimate`` is False, which
    saves a third of the time.

    Raises
    ------
    SceneError
        If the march would not end.
    """
    stride = 1 if envelope else march.store_every
    options = MarchOptions(march.time_step, stride, tolerance, estimate=estimate)
    demand_end(loads, options, REMEDY, stored=not envelope)
    segments, begun = loads.segments(), None
    if envelope and end is not None:
        end, begun = parted(end)
    start = loaded(problem, loads) if end is None else end
    if envelope:
        blocks = integrate(problem, loads, options, start=start)
        yield from enveloped(blocks, segments, begun)
        return
    for rows in integrate(problem, loads, options, start=start):
        sine = clock(segments, rows.time)
        yield replace(rows, frequency=sine[:, 0], level=sine[:, 1])


def kept(blocks: Iterable[Any], keep: Callable[[Any], None]) -> str:
    """Hand blocks on as they come; return how the march ended.

    What stops it before the first block is raised.
    """
    some = False
    try:
        with unmasked():
            for block in blocks:
                keep(block)
                some = True
    except IntegrationError as error:
        if not some:
            raise
        return str(error)
    except KeyboardInterrupt:
        if not some:
            raise
        return "interrupted"
    return "complete"


def march_sweep(
    problem: Problem,
    sweep: LoadHistory,
    march: March,
    watch: Watch = iter,
    *,
    tolerance: float | None = None,
    estimate: bool = True,
) -> TimeHistory:
    """March loads; keep what there is when it cannot go on or is stopped."""
    blocks: list[TimeHistory] = []
    marching = marched(problem, sweep, march, tolerance=tolerance, estimate=estimate)
    ending = kept(watch(marching), blocks.append)
    return joined(blocks, ending)


def march_whole(
    problem: Problem,
    sweep: LoadHistory,
    march: March,
    watch: Watch = iter,
    *,
    estimate: bool = True,
) -> TimeHistory:
    """March a sweep to its end, or raise: a part of it would give wrong energies."""
    history = march_sweep(problem, sweep, march, watch, estimate=estimate)
    if history.ending == "interrupted":
        raise KeyboardInterrupt
    if history.ending != "complete":
        raise IntegrationError(history.ending)
    return history


def swept_sine(sweep: Sweep, *, slower: float = 1.0) -> SweptSine:
    """Return a scene's upward exponential sweep, made ``slower`` times as long."""
    longer = (slower - 1.0) * (sweep.end - sweep.start)
    return SweptSine(
        sweep.ramp,
        sweep.start,
        sweep.end + longer,
        sweep.duration + longer,
        sweep.lowest,
        sweep.highest,
    )
